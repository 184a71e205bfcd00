// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/frame_times.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <regex>

#include <cpl_conv.h>
#include <cpl_string.h>

namespace tetrakis::gdal {
namespace {

constexpr int64_t kNano = 1'000'000'000;
/// Years before have days that the calendar of everyday life has not.
constexpr int kFirstYear = 1583;

/// A unit of CF in microseconds; the names of units with a fixed length.
struct Unit {
  const char* name;
  const char* other;
  uint64_t microseconds;
};
constexpr std::array kUnits = {
    Unit{"day", "d", 86'400'000'000},  Unit{"hour", "h", 3'600'000'000},
    Unit{"minute", "min", 60'000'000}, Unit{"second", "s", 1'000'000},
    Unit{"millisecond", "ms", 1000},   Unit{"microsecond", "us", 1},
};

bool isEveryday(const std::string& calendar) {
  for (const char* const name : {"", "standard", "gregorian", "proleptic_gregorian"})
    if (EQUAL(calendar.c_str(), name)) return true;
  return false;
}

/// Where a product of two is surely one of 64 bits.
bool isSmall(uint64_t number) {
  return number < uint64_t{1} << 31;
}

/// The time of a tick.
std::optional<Moment> momentOfTick(const SequenceClock& clock, int64_t ticks) {
  const std::optional<Moment> epoch = momentOf(clock.epoch);
  const bool known = epoch && isEveryday(clock.calendar) && clock.denominator > 0;
  if (!known || !isSmall(clock.numerator) || !isSmall(clock.denominator)) return std::nullopt;
  const auto numerator = static_cast<int64_t>(clock.numerator);
  const auto denominator = static_cast<int64_t>(clock.denominator);
  int64_t whole = ticks / denominator, rest = ticks % denominator;
  if (rest < 0) --whole, rest += denominator;
  if (std::abs(whole) > INT64_MAX / 4 / numerator) return std::nullopt;
  const int64_t parts = rest * numerator;
  const double part = static_cast<double>(parts % denominator) / static_cast<double>(denominator);
  Moment moment{epoch->seconds + whole * numerator + parts / denominator,
                epoch->nanoseconds + static_cast<int64_t>(part * kNano + 0.5)};
  if (moment.nanoseconds >= kNano) ++moment.seconds, moment.nanoseconds -= kNano;
  return moment;
}

}  // namespace

std::optional<Moment> momentOf(const std::string& text) {
  static const std::regex form(
      R"(\s*(\d{1,4})-(\d{1,2})-(\d{1,2})(?:[Tt ]\s*(\d{1,2}):(\d{1,2})(?::(\d{1,2})(\.\d*)?)?)?)"
      R"(\s*(?:[Zz]|UTC|GMT|([+-])(\d{1,2}):?(\d{2})?)?\s*)");
  std::smatch parts;
  if (text.size() > 80 || !std::regex_match(text, parts, form)) return std::nullopt;
  const auto number = [&](size_t i) { return std::atoi(parts[i].str().c_str()); };
  using namespace std::chrono;
  const year_month_day day{year(number(1)), month(static_cast<unsigned>(number(2))),
                           std::chrono::day(static_cast<unsigned>(number(3)))};
  if (!day.ok() || number(1) < kFirstYear) return std::nullopt;
  const int east = (60 * number(9) + number(10)) * (parts[8].str() == "-" ? -1 : 1);
  const int64_t days = sys_days(day).time_since_epoch().count();
  const double fraction = parts[7].length() > 1 ? CPLAtof(("0" + parts[7].str()).c_str()) : 0;
  return Moment{86400 * days + 3600 * number(4) + 60 * (number(5) - east) + number(6),
                static_cast<int64_t>(fraction * kNano + 0.5)};
}

std::string rfc3339(const SequenceClock& clock, int64_t ticks) {
  const std::optional<Moment> moment = momentOfTick(clock, ticks);
  if (!moment) return "";
  using namespace std::chrono;
  const sys_seconds at{seconds(moment->seconds)};
  const auto midnight = floor<days>(at);
  const year_month_day day(midnight);
  if (!day.ok() || int(day.year()) < 0 || int(day.year()) > 9999) return "";
  const hh_mm_ss time(at - midnight);
  std::string text = CPLSPrintf(
      "%04d-%02u-%02uT%02d:%02d:%02d", int(day.year()), unsigned(day.month()), unsigned(day.day()),
      int(time.hours().count()), int(time.minutes().count()), int(time.seconds().count()));
  if (moment->nanoseconds > 0) {
    text += CPLSPrintf(".%09d", int(moment->nanoseconds));
    text.erase(text.find_last_not_of('0') + 1);
  }
  return text + "Z";
}

std::optional<CfUnit> cfUnit(const SequenceClock& clock) {
  if (clock.denominator == 0) return std::nullopt;
  std::string since = clock.epoch;
  if (!since.empty() && (since.back() == 'Z' || since.back() == 'z')) since.pop_back();
  if (since.size() > 10 && (since[10] == 'T' || since[10] == 't')) since[10] = ' ';
  if (!since.empty()) since.insert(0, " since ");
  const bool small = isSmall(clock.numerator) && isSmall(clock.denominator);
  for (const Unit& unit : kUnits) {
    const uint64_t length = unit.microseconds * clock.denominator;
    const uint64_t tick = clock.numerator * 1'000'000;
    if (small && isSmall(clock.denominator * 86400) && tick % length == 0)
      return CfUnit{unit.name + ("s" + since), static_cast<double>(tick / length)};
  }
  return CfUnit{"seconds" + since,
                static_cast<double>(clock.numerator) / static_cast<double>(clock.denominator)};
}

std::optional<SequenceClock> clockOfCf(const std::string& units, const std::string& calendar) {
  const size_t since = units.find(" since ");
  if (since == std::string::npos) return std::nullopt;
  const std::string name = units.substr(0, since);
  for (const Unit& unit : kUnits) {
    const std::string plural = std::string(unit.name) + "s";
    if (!EQUAL(name.c_str(), unit.name) && !EQUAL(name.c_str(), plural.c_str()) &&
        !EQUAL(name.c_str(), unit.other))
      continue;
    const bool seconds = unit.microseconds >= 1'000'000;
    return SequenceClock{seconds ? unit.microseconds / 1'000'000 : 1,
                         seconds ? 1 : 1'000'000 / unit.microseconds, units.substr(since + 7),
                         calendar};
  }
  return std::nullopt;
}

}  // namespace tetrakis::gdal
