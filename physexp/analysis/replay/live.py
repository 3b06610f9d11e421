"""Episodes in the viewer while they are played."""

from typing import Protocol

import rerun as rr
import rerun.blueprint as rrb

from physexp.agents import environment_loop
from physexp.analysis.replay import layout, recording, words, writing


class Screen(Protocol):
    """Shows streams, as `viewing.Viewer` does."""

    def show(self, stream: rr.RecordingStream, layout: rrb.Blueprint) -> None:
        """Connects a stream."""

    def flush(self, stream: rr.RecordingStream) -> None:
        """Sends the data of a stream."""


class Live(environment_loop.Observer):
    """Shows an episode while it is played: the observations at first, and everything after its end."""

    def __init__(self, recorder: recording.EpisodeRecorder, screen: Screen):
        """Prepares to show.

        Args:
          recorder: observes the same episodes, before this observer does.
          screen: shows the stream of each episode.
        """
        self._recorder, self._screen = recorder, screen

    def observe_first(self, environment, timestep):
        episode = self._recorder.episode
        self._stream = rr.RecordingStream(
            f"physexp-{episode.domain}-{episode.task}", recording_id=f"{episode.seed}-{episode.episode}-live"
        )
        self._screen.show(self._stream, layout.blueprint([episode], [""]))
        self._stream.send_recording_name(words.name(episode))
        self._show(is_over=False)

    def observe(self, environment, timestep, action):
        self._show(timestep.last())

    def get_metrics(self):
        """Returns no metrics."""
        return {}

    def _show(self, is_over: bool) -> None:
        episode = self._recorder.episode
        writer = writing.EpisodeWriter(self._stream, episode, "")
        writer.write() if is_over else writer.write_so_far()
        self._screen.flush(self._stream)
