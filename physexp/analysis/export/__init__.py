"""Whole trajectories to learn from, in formats that others read (docs/export.md)."""
