"""Episodes in the viewer while they are played."""

from physexp.agents import environment_loop
from physexp.analysis.replay import layout, recording, viewing, writing


class Live(environment_loop.Observer):
    """Shows an episode while it is played: the observations at first, and everything after its end."""

    def __init__(self, recorder: recording.EpisodeRecorder, screen: viewing.Viewer):
        """Prepares to show the episodes of a recorder, which must observe them before this observer."""
        self._recorder, self._screen = recorder, screen

    def observe_first(self, environment, timestep):
        episode = self._recorder.episode
        self._stream = writing.new_stream(episode, "live")
        self._screen.show(self._stream, layout.blueprint([episode], [""]))
        self._show(is_over=False)

    def observe(self, environment, timestep, action):
        self._show(timestep.last())

    def _show(self, is_over: bool) -> None:
        writer = writing.EpisodeWriter(self._stream, self._recorder.episode, "")
        writer.write() if is_over else writer.write_so_far()
        self._screen.flush(self._stream)
