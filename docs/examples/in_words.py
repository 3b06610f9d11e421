"""An agent that is asked in words, as a language model is: by a program that reads a prompt and writes a number.

EXPERIMENTER="PROGRAM ITS ARGUMENTS" physexp score in_words:make --tasks strings/features --episodes 20 --timeout 99
"""

import os
import re
import shlex
import subprocess


def make(question):
    """Returns a policy that tells the program all that has happened, before each action anew."""
    program = shlex.split(os.environ["EXPERIMENTER"])
    meanings = "\n".join(f"{name}: {meaning}" for name, meaning in question.observation_meanings.items())
    actions = "\n".join(f"{number}: {name}" for number, name in enumerate(question.action_names))
    task = f"""You experiment to answer a question: {question.question}
The right answer earns 1, a wrong one -1, and so does none within {question.step_limit} actions.
Every action before the answer makes what you earn {question.discount} times as much.
These are the actions:
{actions}
This is what you see:
{meanings}
This is what has happened:"""

    def policy(observation, story):
        story = [*(story or []), "You see " + "; ".join(f"{name} {value}" for name, value in observation.items()) + "."]
        prompt = "\n".join([task, *story, "Which action do you take? End with its number."])
        reply = subprocess.run(program, input=prompt, stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout
        action = int(re.findall(r"\d+", reply)[-1])
        return action, [*story, f"You do: {question.action_names[action]}."]

    return policy
