"""Importing the suite costs nothing it need not: no torch, no GL context, no process, no thread."""

import _ctypes
import shutil

import interpreters

# A GL context of dm_control or of mujoco is an object, with one of these among the classes of its class.
LOOK_AROUND = """
import gc, os, sys, threading
def look_around():
    contexts = {"GLContext", "MjrContext", "ContextBase"}
    classes = [{kind.__name__ for kind in type(thing).__mro__} for thing in gc.get_objects()]
    return {
        "children": len(open(f"/proc/self/task/{os.getpid()}/children").read().split()),
        "threads": threading.active_count(),
        "contexts": sum(not contexts.isdisjoint(names) for names in classes),
        "loaded": sorted({name.split(".")[0] for name in sys.modules}),
        "physexp": sorted(name for name in sys.modules if name.startswith("physexp")),
    }
"""


def test_importing_starts_nothing_opens_no_context_and_loads_no_torch():
    found, _ = interpreters.run(f"{LOOK_AROUND}\nimport physexp.suite\nfound.update(look_around())")
    assert (found["children"], found["threads"], found["contexts"]) == (0, 1, 0)
    unwanted = {"torch", "matplotlib", "pandas", "pyarrow", "rerun", "gymnasium", "ray", "tensorboard"}
    assert not unwanted & set(found["loaded"])
    assert [name for name in found["physexp"] if not name.startswith("physexp.suite")] == ["physexp", "physexp.checks"]


def test_training_does_not_import_the_compiler_of_torch():
    """Three seconds of each process that trains."""
    found, _ = interpreters.run("""
import sys, torch
from physexp.agents import learning
variables = learning.Variables(torch.nn.Linear(2, 1))
variables.apply([torch.ones(1, 2), torch.ones(1)], learning_rate=0.001)
found["compiler"] = "torch._dynamo" in sys.modules
""")
    assert found == {"compiler": False}


def test_triton_is_loaded_before_gl_since_after_mesa_it_ends_the_process(tmp_path):
    """Torch's CUDA builds bring it, and its LLVM and Mesa's bear each other in this order only."""
    (tmp_path / "triton" / "_C").mkdir(parents=True)
    (tmp_path / "triton" / "__init__.py").write_text("raise AssertionError('this takes half a second: not yet')")
    shutil.copy(_ctypes.__file__, tmp_path / "triton" / "_C" / "libtriton.so")  # Any library is like it.
    code = f"""
import sys
sys.path.insert(0, {str(tmp_path)!r})
opened = []
sys.addaudithook(lambda event, arguments: event == "ctypes.dlopen" and opened.append(str(arguments[0])))
import physexp.suite
found["opened"] = [name for name in opened if any(word in name for word in ("libtriton", "EGL", "OSMesa"))]
"""
    opened = interpreters.run(code, MUJOCO_GL=None)[0]["opened"]
    assert opened[0].endswith("triton/_C/libtriton.so")
    assert len(opened) > 1, "a library of GL is here too"
