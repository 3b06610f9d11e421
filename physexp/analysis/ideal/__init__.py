"""Ideal experimenters: the best policies and their values, by family of questions (docs/ideal.md)."""
