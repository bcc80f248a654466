"""Time limits inside the process: an alarm that rings until it is heard."""

import signal


class CellTimeout(BaseException):
    """Not an Exception, so that a student's `except Exception` does not swallow it."""


def listen():
    """Makes both alarms raise `CellTimeout`."""
    for bell in (signal.SIGALRM, signal.SIGPROF):
        signal.signal(bell, _ring)


def limited(seconds, action, *arguments):
    """What an action returned and what it raised, under an alarm that rings again.

    A bare except could swallow it once.
    """
    try:
        # Processor time, for a busy machine is no loop; on the clock, for a cell that waits.
        signal.setitimer(signal.ITIMER_PROF, seconds, 0.2)
        signal.setitimer(signal.ITIMER_REAL, 3 * seconds, 0.2)
        try:
            result = action(*arguments), None
        finally:
            _silence()
    except BaseException as error:
        result = None, error
    _silence()  # again, where an alarm rang while the first was at it
    return result


def _silence():
    signal.setitimer(signal.ITIMER_PROF, 0)
    signal.setitimer(signal.ITIMER_REAL, 0)


def _ring(*_):
    raise CellTimeout
