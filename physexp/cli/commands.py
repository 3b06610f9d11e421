"""The commands by name, in the order in which help lists them."""

from physexp.cli import demo, doctor, experiments, export, ideal, instances, playing, score, serve, sweep, tasks, train

COMMANDS = {
    "tasks": tasks.Tasks,
    "train": train.Train,
    "evaluate": playing.Evaluate,
    "replay": playing.Replay,
    "play": playing.Play,
    "page": playing.Page,
    "publish": playing.Publish,
    "ideal": ideal.Ideal,
    "score": score.Score,
    "draw-instances": instances.DrawInstances,
    "verify": score.Verify,
    "leaderboard": score.Leaderboard,
    "export": export.Export,
    "serve": serve.Serve,
    "sweep": sweep.Sweep,
    "reproduce": experiments.Reproduce,
    "report": experiments.Report,
    "bench": experiments.Bench,
    "doctor": doctor.Doctor,
    "demo": demo.Demo,
}
