"""Environments in which an agent must experiment to learn what it cannot see."""

__version__ = "0.1.0"
