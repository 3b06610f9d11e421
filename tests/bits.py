"""Damage to files, in tests."""


def flipped(content: bytes, bit: int) -> bytes:
    """Returns a content with one bit changed."""
    changed = bytearray(content)
    changed[bit // 8] ^= 1 << bit % 8
    return bytes(changed)
