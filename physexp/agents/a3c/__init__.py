"""A3C, asynchronous advantage actor-critic, on one machine."""
