# SPDX-License-Identifier: Apache-2.0
"""What the times of the frames of a sequence mean, and how they become dates.

Times are whole numbers of ticks after an epoch, so that they are exact: 30 frames a second, hours
of a year of 365 days, months of none.
"""

from __future__ import annotations

import ctypes
import datetime
import math
import operator
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import Any, Iterable, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _sequence_library as s
from . import _values as values
from ._errors import TksUsageError

# Of the CF conventions, section 4.4; those of no fixed length, month and year, are not here.
_UNITS = {
    "microsecond": Fraction(1, 10**6),
    "millisecond": Fraction(1, 1000),
    "second": Fraction(1),
    "minute": Fraction(60),
    "hour": Fraction(3600),
    "day": Fraction(86400),
}
_SHORT = {"us": "microsecond", "ms": "millisecond", "msec": "millisecond", "s": "second",
          "sec": "second", "min": "minute", "h": "hour", "hr": "hour", "d": "day"}  # fmt: skip
_EPOCH = re.compile(
    r"\s*(\d{1,4})-(\d{1,2})-(\d{1,2})"
    r"(?:[Tt ]\s*(\d{1,2}):(\d{1,2})(?::(\d{1,2})(\.\d*)?)?)?"
    r"\s*(?:[Zz]|UTC|GMT|([+-])(\d{1,2}):?(\d{2})?)?\s*"
)
# Calendars of NumPy's dates; the two others are Julian before October 1582.
_PROLEPTIC, _GREGORIAN = "proleptic_gregorian", (None, "standard", "gregorian")
_DATE_UNITS = (("s", 1), ("ms", 10**3), ("us", 10**6), ("ns", 10**9))

TickLike = Union[Fraction, int, float, str]


@dataclass(frozen=True)
class Clock:
    """What a tick of the times of a sequence is, and when tick 0 is.

        Clock(Fraction(1, 30))                               # 30 frames a second
        Clock(3600, "2019-03-01T00:00:00Z")                  # hours
        Clock.cf("hours since 1900-01-01 00:00", "noleap")   # as the CF conventions say it
    """

    tick: Optional[Fraction] = None
    """Seconds; None: nobody knows. Floats are taken for the fraction that they are nearest to, of
    a denominator up to a million."""
    epoch: Optional[str] = None
    """As RFC 3339 has it, or CF."""
    calendar: Optional[str] = None
    """As CF has it; None: that of everyday life."""

    def __post_init__(self) -> None:
        if self.tick is not None:
            object.__setattr__(self, "tick", _fraction(self.tick))
        for name in ("epoch", "calendar"):
            values.text(getattr(self, name), name)
            object.__setattr__(self, name, getattr(self, name) or None)

    @classmethod
    def cf(cls, units: str, calendar: Optional[str] = None) -> "Clock":
        """Of the attributes that CF gives a time: "hours since 1900-01-01"."""
        parts = re.fullmatch(r"\s*(\w+)\s+since\s+(.+?)\s*", units)
        name = "" if parts is None else parts[1].lower()
        name = _SHORT.get(name, name[:-1] if name.endswith("s") else name)
        if parts is None or name not in _UNITS:
            raise TksUsageError(
                f'{values.told(units)} are no units of times such as "hours since 1900-01-01"; '
                "months and years have no length."
            )
        return cls(_UNITS[name], parts[2], calendar)

    def dates(self, ticks: NDArray[np.int64]) -> Optional[NDArray[Any]]:
        """datetime64 of the coarsest unit that holds them, else the nearest nanosecond; None where
        there is no epoch, or the calendar has other days."""
        epoch = self._epoch_seconds()
        if epoch is None or self.tick is None:
            return None
        for unit, part in _DATE_UNITS:
            step, first = self.tick * part, epoch * part
            if step.denominator == 1 and first.denominator == 1 or unit == "ns":
                return _dates(ticks, step, first, unit)
        return None

    def cf_times(self, ticks: NDArray[np.int64]) -> Tuple[NDArray[Any], str]:
        """Numbers and units as CF has them: of the longest unit in which a tick is whole, else of
        seconds. Without an epoch they are a length of time."""
        since = "" if self.epoch is None else f" since {_epoch_of_cf(self.epoch)}"
        tick = self.tick or Fraction(1)
        for name, length in reversed(_UNITS.items()):
            if (tick / length).denominator == 1:
                return ticks * int(tick / length), f"{name}s{since}"
        return ticks * float(tick), f"seconds{since}"

    def ticks(self, time: Any) -> int:
        """Of ticks that are such already, and of a date, which has to be that of a tick."""
        tick = self._place(time)
        if tick.denominator != 1:
            raise TksUsageError(f"{time} lies between two ticks of {self.tick} s.")
        return int(tick)

    def floor(self, time: Any) -> int:
        """The last tick that is not after a time."""
        return math.floor(self._place(time))

    def _place(self, time: Any) -> Fraction:
        """In ticks."""
        if isinstance(time, (datetime.datetime, np.datetime64)):
            epoch = self._epoch_seconds()
            if epoch is None or self.tick is None:
                raise TksUsageError(
                    "Dates are times of a sequence whose clock has a tick, and an epoch in the "
                    "calendar of everyday life."
                )
            return (_seconds_of(time) - epoch) / self.tick
        try:
            number = operator.index(time)
        except TypeError:
            raise TksUsageError(
                f"A time is a number of ticks or a date, not {values.told(time)}."
            ) from None
        if abs(number) > 2**61:
            raise TksUsageError("A time lies within 2^61 ticks of the epoch.")
        return Fraction(number)

    def _epoch_seconds(self) -> Optional[Fraction]:
        """After 1970-01-01, in NumPy's calendar; None: unknown."""
        parts = _EPOCH.fullmatch(self.epoch or "")
        if parts is None or self.calendar not in (*_GREGORIAN, _PROLEPTIC):
            return None
        year, month, day = (int(parts[i]) for i in (1, 2, 3))
        if self.calendar != _PROLEPTIC and year < 1583:
            return None
        try:
            days = np.datetime64(f"{year:04}-{month:02}-{day:02}", "D").astype(np.int64)
        except ValueError:
            return None
        hours, minutes, seconds = (int(parts[i] or 0) for i in (4, 5, 6))
        east = 60 * int(parts[9] or 0) + int(parts[10] or 0)
        minutes -= -east if parts[8] == "-" else east
        fraction = Fraction("0" + parts[7] if parts[7] not in (None, ".") else 0)
        return 86400 * int(days) + 3600 * hours + 60 * minutes + seconds + fraction

    def struct(self) -> s.Clock:
        """The struct of the C interface."""
        tick = self.tick or Fraction(0)
        return s.Clock(
            size=ctypes.sizeof(s.Clock),
            numerator=tick.numerator,
            denominator=tick.denominator if tick else 0,
            epoch=values.text(self.epoch, "epoch"),
            calendar=values.text(self.calendar, "calendar"),
        )


def _epoch_of_cf(epoch: str) -> str:
    """RFC 3339 has letters where CF has spaces."""
    return re.sub(r"(?<=\d)[Tt](?=\d)", " ", re.sub(r"(?<=\d)[Zz]$", "", epoch))


def from_struct(raw: s.Clock) -> Clock:
    tick = Fraction(raw.numerator, raw.denominator) if raw.denominator else None
    texts = ((text or b"").decode("utf-8", "replace") for text in (raw.epoch, raw.calendar))
    return Clock(tick, *texts)


ClockLike = Union[Clock, TickLike, None]


def clock_of(given: ClockLike) -> Clock:
    """A clock, the units of CF, or the seconds of a tick."""
    if isinstance(given, Clock):
        return given
    if isinstance(given, str):
        return Clock.cf(given)
    return Clock(given)  # type: ignore[arg-type]


def timeline(times: Any, clock: ClockLike) -> Tuple[Clock, Optional[Iterable[Any]]]:
    """The clock of these times, and the times as its ticks or dates. An array says its clock
    itself, where it has dates; numbers that are not whole make the ticks of the clock shorter."""
    known = clock_of(clock)
    if times is None or not hasattr(times, "__len__"):
        return known, times
    array = np.asarray(times)
    if array.dtype.kind == "O":
        array = np.array([_without_zone(time) for time in times], "M8[us]")
    if array.ndim != 1:
        raise TksUsageError("The times of frames are in one row, one for each.")
    if array.dtype.kind == "M" and clock is None and array.size:
        return _clock_of_dates(array)
    if array.dtype.kind == "f":
        return _finer(known, array)
    return known, array if array.dtype.kind == "M" else array.tolist()


def _clock_of_dates(dates: NDArray[Any]) -> Tuple[Clock, Iterable[int]]:
    """Tick 0 is the first one, and a tick the longest time of which all others are multiples."""
    seconds = [_seconds_of(date) for date in dates]
    after = [second - seconds[0] for second in seconds]
    parts = _common(after)
    longest = reduce(math.gcd, (int(each * parts) for each in after))
    tick = Fraction(longest or parts, parts)
    epoch = str(dates[0].astype("M8[s]") if seconds[0].denominator == 1 else dates[0])
    return Clock(tick, f"{epoch}Z"), [int(each / tick) for each in after]


def _finer(clock: Clock, numbers: NDArray[Any]) -> Tuple[Clock, Iterable[int]]:
    if not np.isfinite(numbers).all():
        raise TksUsageError("The times of frames are finite numbers.")
    parts = [Fraction(float(number)).limit_denominator(86400 * 1000) for number in numbers]
    whole = _common(parts)
    if whole > 1 and clock.tick is None:
        raise TksUsageError("Times that are not whole take a clock: seconds, or units of CF.")
    tick = None if clock.tick is None else clock.tick / whole
    return Clock(tick, clock.epoch, clock.calendar), [int(part * whole) for part in parts]


def _common(parts: Iterable[Fraction]) -> int:
    """The least denominator that all have."""
    denominators = (part.denominator for part in parts)
    return reduce(lambda a, b: a // math.gcd(a, b) * b, denominators, 1)


def _fraction(tick: Any) -> Fraction:
    try:
        exact = Fraction(tick)
    except (TypeError, ValueError, OverflowError):
        exact = Fraction(0)
    if isinstance(tick, float):
        exact = exact.limit_denominator(10**6)
    if exact <= 0 or max(exact.numerator, exact.denominator) >= 2**64:
        raise TksUsageError(f"A tick lasts more than 0 seconds, not {values.told(tick)}.")
    return exact


def _without_zone(time: Any) -> Any:
    if isinstance(time, datetime.datetime) and time.tzinfo is not None:
        return time.astimezone(datetime.timezone.utc).replace(tzinfo=None)
    if not isinstance(time, (datetime.datetime, np.datetime64)):
        raise TksUsageError(f"A time is a number of ticks or a date, not {values.told(time)}.")
    return time


def _seconds_of(time: Any) -> Fraction:
    """After 1970-01-01."""
    date = np.datetime64(_without_zone(time))
    if np.isnat(date):
        raise TksUsageError("NaT is no time of a frame.")
    finest = "ns" if np.datetime_data(date.dtype)[0] == "ns" else "us"
    count = int(date.astype(f"M8[{finest}]").astype(np.int64))
    return Fraction(count, 10**9 if finest == "ns" else 10**6)


def _dates(
    ticks: NDArray[np.int64], step: Fraction, first: Fraction, unit: str
) -> Optional[NDArray[Any]]:
    """first + ticks * step, rounded, in integers that do not overflow where the dates do not."""
    whole, rest = np.divmod(ticks, step.denominator)
    furthest = max((abs(int(ticks[i])) for i in (0, -1) if ticks.size), default=0)
    if furthest * step + abs(first) >= 2**63 or step.denominator * step.numerator >= 2**61:
        return None
    parts = (2 * rest * step.numerator + step.denominator) // (2 * step.denominator)
    return (round(first) + whole * step.numerator + parts).astype(f"M8[{unit}]")
