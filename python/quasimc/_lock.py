"""A scene has one run at a time and can't be changed during it."""

import threading


class OneAtATime:
    """A lock that several threads wait for, and that raises where its own thread would wait for ever."""

    def __init__(self):
        self._lock = threading.Lock()
        self._owner = None

    def __enter__(self):
        if self._owner == threading.get_ident():
            raise _busy()
        self._lock.acquire()
        self._owner = threading.get_ident()

    def __exit__(self, *exception):
        self._owner = None
        self._lock.release()

    def to_change(self):
        """The same for changes, which no thread waits for: raises while another one has the lock."""
        return _Change(self._lock)


class _Change:
    """Holds a lock that is free."""

    def __init__(self, lock):
        self._lock = lock

    def __enter__(self):
        if not self._lock.acquire(blocking=False):
            raise _busy()

    def __exit__(self, *exception):
        self._lock.release()


def _busy():
    return RuntimeError(
        "this scene is being computed: a progress callback can't change or run it; "
        "do so when run() has returned"
    )
