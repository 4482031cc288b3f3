"""Section 3.1: the classifiers that learn to avoid obstacles. The paper gives none of their parameters."""
