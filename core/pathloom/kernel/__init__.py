"""The kernel: populations, values, operators, slots, states and names. It knows nothing of paths."""
