"""One run of a scene at a time."""

import threading


class OneAtATime:
    """A lock that several threads wait for, and that raises where its own thread would wait for ever."""

    def __init__(self):
        self._lock = threading.Lock()
        self._owner = None

    def __enter__(self):
        if self._owner == threading.get_ident():
            raise RuntimeError(
                "this scene is being computed: a progress callback can't change or run it; "
                "do so when run() has returned"
            )
        self._lock.acquire()
        self._owner = threading.get_ident()

    def __exit__(self, *exception):
        self._owner = None
        self._lock.release()
