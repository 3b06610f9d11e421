"""A bit that has flipped, anywhere in any file, is harmless or noticed; nothing crashes, hangs or takes much memory."""

import json

import attacks
import bits
import pytest
import reading

pytestmark = pytest.mark.long

MEMORY = 2 << 30  # Bytes beyond those of the imports.


def flip(name, folder, seed, count):
    """Flips bits of a file, one after the other, and leaves what came of each as JSON: a list of [bit, outcome]."""
    generator = attacks.random.Random(seed)
    file = reading.FILES[name]
    path = file.find(folder)
    content = path.read_bytes()
    expected = file.read(folder)
    came_of = []
    for _ in range(count):
        bit = generator.randrange(8 * len(content))
        print(f"{path.name}: bit {bit}", flush=True)
        path.write_bytes(bits.flipped(content, bit))
        try:
            came_of.append((bit, reading.outcome(file, path, folder, expected)))
        except Exception as error:  # Of whatever kind: it is reported with the bit, and the others are tried.
            came_of.append((bit, f"{type(error).__name__}: {error}"))
    path.write_bytes(content)
    (folder / "came_of").write_text(json.dumps(came_of))


@pytest.mark.parametrize("name", reading.FILES)
def test_a_flipped_bit_is_harmless_or_noticed(name, made):
    seed = attacks.generator().getrandbits(32)
    end = attacks.run(flip, name, made, seed, attacks.repetitions(25, share=5), first=attacks.Memory(MEMORY))
    assert end.code == 0, end.said[-2000:]
    allowed = {"the same", "refused"} | (set() if reading.FILES[name].has_checksum else {"another value"})
    bad = {}
    with attacks.Tally(f"bit flip, {name}") as tally:
        for bit, outcome in json.loads((made / "came_of").read_text()):
            tally[outcome if outcome in allowed else "BAD"] += 1
            if outcome not in allowed:
                bad.setdefault(outcome[:150], []).append(bit)
    assert not bad, "\n".join(f"{len(bits)} times, bit {bits[0]}: {outcome}" for outcome, bits in bad.items())
