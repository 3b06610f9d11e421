"""Agents for tests: the text of a module for the folder in which a score starts."""

from pathlib import Path
import shutil
import textwrap

EXAMPLES = Path(__file__).parents[3] / "docs" / "examples"

_MODULE = textwrap.dedent(
    '''
    """Agents of all sorts."""

    import os
    import signal
    import subprocess
    import sys
    import textwrap
    import time
    from pathlib import Path

    import halving

    episodes = 0


    def _after_two_episodes(happens):
        """A policy that halves, until something happens before the first action of the third episode."""

        def policy(observation, state):
            global episodes
            episodes += state is None
            if episodes == 3:
                return happens(), state
            return halving.policy(observation, state)

        return policy


    def _hang():
        Path("hanging").touch()
        while True:
            time.sleep(60)


    def opens_what_is_not_there(question):
        return _after_two_episodes(lambda: Path("nowhere").read_text())


    def returns_no_pair(question):
        fails = _after_two_episodes(lambda: None)

        def policy(observation, state):
            action, state = fails(observation, state)
            return 3 if action is None else (action, state)

        return policy


    def dies(question):
        return _after_two_episodes(lambda: os.kill(os.getpid(), signal.SIGKILL))


    def hangs(question):
        return _after_two_episodes(_hang)


    _PROGRAM = """
    import json, os, signal, time
    from pathlib import Path
    handlers = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
    blocked = [*map(int, signal.pthread_sigmask(signal.SIG_BLOCK, []))]
    Path("written").write_text(json.dumps([os.getpid(), blocked, *(getattr(one, "__name__", one) for one in handlers)]))
    Path("written").rename("program")
    time.sleep(10_000)
    """


    def starts_a_program(question):
        subprocess.Popen([sys.executable, "-c", textwrap.dedent(_PROGRAM)])
        while not Path("program").exists():
            time.sleep(0.01)
        return _after_two_episodes(_hang)


    def chooses_text(question):
        return _after_two_episodes(lambda: "push")


    def chooses_too_much(question):
        return _after_two_episodes(lambda: question.action_spec.num_values)


    def makes_nothing(question):
        return 7


    def waits(observation, state):
        """Halves; notes each episode that begins, and waits for a file in the third."""
        if state is None:
            with open("begun", "a") as file:
                file.write("x")
            while os.path.getsize("begun") == 3 and not os.path.exists("go"):
                time.sleep(0.01)
        return halving.policy(observation, state)


    def of_three(observation, state, third):
        return 0, state


    number = 5


    class Told:
        """An actor that writes down all calls, and answers at last."""

        def __init__(self, question):
            print("made for", question.name)
            self.question, self.told = question, []

        def select_action(self, observation):
            self.told.append(f"asked {sorted(observation)}")
            return self.question.num_interactions if len(self.told) > 4 else 0

        def observe_first(self, timestep):
            self.told = [f"first {timestep.reward} {timestep.discount}"]

        def observe(self, action, next_timestep):
            self.told.append(f"saw {action} {next_timestep.discount}")
            Path("told").write_text("; ".join(self.told))

        def update(self):
            self.told.append("updated")
    '''
)


def put_into(folder: Path) -> None:
    """Makes the modules `made` and `halving` in a folder."""
    shutil.copy(EXAMPLES / "halving.py", folder)
    (folder / "made.py").write_text(_MODULE)
