# SPDX-License-Identifier: Apache-2.0
"""Times of frames: ticks, dates, and the words of the CF conventions."""

import datetime
from fractions import Fraction

import numpy as np
import pytest

import tetrakis
from tetrakis import Clock

FRAMES = np.arange(5 * 6, dtype="i2").reshape(5, 2, 3)


def opened(**given):
    return tetrakis.open_sequence(tetrakis.encode_sequence(FRAMES, **given))


@pytest.mark.parametrize("unit", ["D", "h", "m", "s", "ms", "us", "ns"])
@pytest.mark.parametrize("first", ["1969-12-30T22:10", "2019-03-01T00:00:00.25", "2261-01-02"])
def test_dates_come_back(unit, first):
    dates = np.datetime64(first).astype(f"M8[{unit}]") + np.array([0, 1, 3, 4, 50])
    sequence = opened(times=dates)
    np.testing.assert_array_equal(sequence.times, dates)
    assert sequence.ticks.tolist() == [0, 1, 3, 4, 50]
    for number, date in enumerate(dates):
        assert sequence.find(date) == number
    assert sequence.find(dates[1] + 1) == 1 and sequence.find(dates[4] + 1) == 4
    assert sequence.find(dates[0] - 1) == 0
    np.testing.assert_array_equal(sequence.at(dates[3]).heights(), FRAMES[3])


def test_python_dates_and_zones():
    zone = datetime.timezone(datetime.timedelta(hours=2))
    dates = [datetime.datetime(2020, 2, 28 + day, 1, tzinfo=zone) for day in range(2)]
    dates += [datetime.datetime(2020, 3, day) for day in (1, 2, 3)]
    sequence = opened(times=dates)
    assert sequence.times.astype("M8[m]").astype(str).tolist() == [
        "2020-02-27T23:00", "2020-02-28T23:00", "2020-03-01T00:00", "2020-03-02T00:00",
        "2020-03-03T00:00"]  # fmt: skip
    assert sequence.clock == Clock(3600, "2020-02-27T23:00:00Z")


@pytest.mark.parametrize("clock, first, second", [
    ("hours since 1900-01-01 00:00:0.0", "1900-01-01T02", "1900-01-01T03"),
    ("days since 2000-02-28", "2000-03-01", "2000-03-02"),
    ("minutes since 2019-03-01T00:30:00+01:00", "2019-02-28T23:32", "2019-02-28T23:33"),
    ("seconds since 1-1-1", None, None),
    (Clock.cf("hr since 1-1-1 0:0", "proleptic_gregorian"), "0001-01-01T02", "0001-01-01T03"),
    (Clock.cf("days since 1990-1-1", "noleap"), None, None),
    (Clock(Fraction(1, 30), "2019-03-01T12:00:00.5Z"), "2019-03-01T12:00:00.566666667",
     "2019-03-01T12:00:00.6"),
    (1 / 30, None, None),
    (None, None, None),
])  # fmt: skip
def test_clocks(clock, first, second):
    ticks = [2, 3, 9, 10, 11]
    sequence = opened(times=ticks, clock=clock)
    assert sequence.ticks.tolist() == ticks
    assert sequence.clock == (Clock.cf(clock) if isinstance(clock, str) else
                              clock if isinstance(clock, Clock) else Clock(clock))  # fmt: skip
    if first is None:
        assert sequence.times.tolist() == ticks
    else:
        wanted = np.array([first, second], "M8[ns]" if "." in first else "M8[s]")
        np.testing.assert_array_equal(sequence.times[:2].astype(wanted.dtype), wanted)
    assert [sequence.find(tick) for tick in (-5, 2, 4, 9, 99)] == [0, 0, 1, 2, 4]


def test_numbers_that_are_not_whole_make_ticks_shorter():
    sequence = opened(times=[0.5, 0.75, 1, 2, 1000.25], clock="hours since 1900-01-01")
    assert sequence.clock == Clock(900, "1900-01-01")
    assert sequence.ticks.tolist() == [2, 3, 4, 8, 4001]
    assert opened(times=np.arange(5) / 3, clock=60).clock.tick == 20
    assert opened(times=[0.0, 1.0, 2.0, 3.0, 4.0]).ticks.tolist() == list(range(5))


def test_times_of_a_live_source():
    with tetrakis.SequenceEncoder(clock="seconds since 2020-01-01", group=2) as encoder:
        encoder.push(FRAMES[0], time=np.datetime64("2020-01-01T00:00:05"))
        encoder.push(FRAMES[1])
        with pytest.raises(tetrakis.TksUsageError, match="between two ticks"):
            encoder.push(FRAMES[2], time=np.datetime64("2020-01-01T00:00:07.5"))
        with pytest.raises(tetrakis.TksUsageError, match="not later"):
            encoder.push(FRAMES[2], time=6)
        encoder.push(FRAMES[2], time=60)
        encoder.flush()
        sequence = tetrakis.open_sequence(encoder.take())
    assert sequence.ticks.tolist() == [5, 6, 60]
    np.testing.assert_array_equal(sequence, FRAMES[:3])


@pytest.mark.parametrize("given, sentence", [
    (dict(clock="months since 2000-01-01"), "months and years"),
    (dict(clock="hours"), "no units"),
    (dict(clock=0), "more than 0"),
    (dict(clock=-1.5), "more than 0"),
    (dict(clock=float("nan")), "more than 0"),
    (dict(times=["a", "b", "c", "d", "e"]), "ticks or a date"),
    (dict(times=[0, 1.5, 2, 3, 4]), "take a clock"),
    (dict(times=[0, 1, 2, 3, float("inf")]), "finite"),
    (dict(times=[0, 1, 2, 3, 2**62]), "2.61"),
    (dict(times=np.array(["NaT"] * 5, "M8[s]")), "NaT"),
    (dict(times=iter(np.array(["2020-01-01"] * 5, "M8[s]"))), "epoch"),
    (dict(times=np.zeros((5, 2))), "one row"),
    (dict(clock=Clock(epoch="2020-01-01")), "known length"),
    (dict(clock=Clock(1, "2020" * 80)), "255"),
])  # fmt: skip
def test_times_that_make_no_sense(given, sentence):
    with pytest.raises(tetrakis.TksUsageError, match=sentence):
        opened(**given)
