"""Tuning of parameters by designed experiments."""
