// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/units.hpp"

#include "apps/scenario/closest_word.hpp"
#include "geometry/base/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

namespace plekton::apps {
namespace {

using Powers = std::array<int, 4>;

struct Symbol {
  std::string_view text;
  double multiplier;  // to SI units: times the multiplier, over the divisor; whole numbers, so that
                      // "9 mm" is the double 0.009
  double divisor;
  Powers powers;
};

// µ is there twice: as the micro sign, U+00B5, and as the Greek letter, U+03BC, that many keyboards
// and editors have.
constexpr Powers kM{0, 1, 0, 0}, kS{0, 0, 1, 0}, kKg{1, 0, 0, 0}, kN{1, 1, -2, 0},
    kPa{1, -1, -2, 0}, kJ{1, 2, -2, 0}, kRad{0, 0, 0, 1};

// clang-format off
constexpr std::array kSymbols = {
    Symbol{"m",   1,    1,    kM},  Symbol{"km",  1e3,  1,   kM},  Symbol{"dm",  1,   10,  kM},  Symbol{"cm", 1, 100, kM},
    Symbol{"mm",  1,    1e3,  kM},  Symbol{"um",  1,    1e6, kM},  Symbol{"µm",  1,   1e6, kM},  Symbol{"nm", 1, 1e9, kM},
    Symbol{"\u03bcm", 1, 1e6, kM}, Symbol{"\u03bcs", 1, 1e6, kS}, Symbol{"\u03bcJ", 1, 1e6, kJ},
    Symbol{"l",   1,    1e3,  {0, 3, 0, 0}},
    Symbol{"s",   1,    1,    kS},  Symbol{"ms",  1,    1e3, kS},  Symbol{"us",  1,   1e6, kS},  Symbol{"µs", 1, 1e6, kS},
    Symbol{"ns",  1,    1e9,  kS},  Symbol{"min", 60,   1,   kS},  Symbol{"h",   3600, 1,  kS},
    Symbol{"Hz",  1,    1,    {0, 0, -1, 0}},
    Symbol{"kg",  1,    1,    kKg}, Symbol{"g",   1,    1e3, kKg}, Symbol{"mg",  1,   1e6, kKg}, Symbol{"t", 1e3, 1, kKg},
    Symbol{"N",   1,    1,    kN},  Symbol{"kN",  1e3,  1,   kN},  Symbol{"MN",  1e6, 1,   kN},  Symbol{"mN", 1, 1e3, kN},
    Symbol{"Pa",  1,    1,    kPa}, Symbol{"hPa", 100,  1,   kPa}, Symbol{"kPa", 1e3, 1,   kPa}, Symbol{"MPa", 1e6, 1, kPa},
    Symbol{"GPa", 1e9,  1,    kPa}, Symbol{"bar", 1e5,  1,   kPa},
    Symbol{"J",   1,    1,    kJ},  Symbol{"kJ",  1e3,  1,   kJ},  Symbol{"mJ",  1,   1e3, kJ},  Symbol{"uJ", 1, 1e6, kJ},
    Symbol{"µJ",  1,    1e6,  kJ},
    Symbol{"rad", 1,    1,    kRad}, Symbol{"deg", std::numbers::pi, 180, kRad}, Symbol{"°", std::numbers::pi, 180, kRad},
    Symbol{"%",   1,    100,  {0, 0, 0, 0}},
};
// clang-format on

constexpr std::array kDimensions = {kNumber, kLength,   kArea,      kVolume,       kTime,
                                    kMass,   kAngle,    kVelocity,  kAcceleration, kForce,
                                    kEnergy, kPressure, kStiffness, kDensity,      kArealMass};

struct Unit {
  double multiplier = 1.0;
  double divisor = 1.0;
  Powers powers{};
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// "a length", or the powers where no name is known.
std::string name_of(const Powers& powers) {
  for (const Dimension& dimension : kDimensions) {
    if (dimension.powers == powers) return std::string(dimension.name);
  }
  constexpr std::array<std::string_view, 4> kBase = {"kg", "m", "s", "rad"};
  std::string text = "a quantity in";
  for (std::size_t i = 0; i < kBase.size(); ++i) {
    if (powers[i] == 0) continue;
    text += fmt::format(" {}{}", kBase[i], powers[i] == 1 ? "" : std::to_string(powers[i]));
  }
  return text;
}

[[noreturn]] void fail(std::string_view text, std::string_view problem, const Dimension& expected) {
  throw UnitError(
      fmt::format("got \"{}\"{}; expected {} ({})", text, problem, expected.name, expected.units));
}

/// Reads a unit such as "kg/m3" from its beginning to its end.
class UnitParser {
 public:
  UnitParser(std::string_view whole, std::string_view unit, const Dimension& expected)
      : whole_(whole), rest_(unit), expected_(expected) {}

  Unit parse() {
    Unit unit;
    int sign = 1;
    while (!rest_.empty()) {
      take_factor(unit, sign);
      rest_ = trimmed(rest_);
      if (rest_.empty()) break;
      const bool slash = take("/");
      if (!slash && sign < 0)
        fail(whole_,
             ", where what follows the slash can be read in two ways; write a slash before each",
             expected_);
      if (slash) sign = -1;
      if (!slash && !take("*")) take("·");
      rest_ = trimmed(rest_);
      if (rest_.empty()) fail(whole_, ", which ends in the middle of a unit", expected_);
    }
    return unit;
  }

 private:
  bool take(std::string_view what) {
    if (!rest_.starts_with(what)) return false;
    rest_.remove_prefix(what.size());
    return true;
  }

  void take_factor(Unit& unit, int sign) {
    const std::string_view symbol = rest_.substr(0, rest_.find_first_of(" \t*/^-+0123456789"));
    const std::string_view name = without_superscript(symbol);
    const auto found = std::find_if(kSymbols.begin(), kSymbols.end(),
                                    [&](const Symbol& s) { return s.text == name; });
    if (name.empty())
      fail(whole_,
           fmt::format(", where a unit is missing before \"{}\"; write the reciprocal of a unit "
                       "with a negative power, as in \"1 s-1\"",
                       rest_),
           expected_);
    if (found == kSymbols.end()) fail_unknown(name);
    rest_.remove_prefix(name.size());

    const int power = sign * take_power();
    const double up = elementary::pow(found->multiplier, std::abs(power));
    const double down = elementary::pow(found->divisor, std::abs(power));
    unit.multiplier *= power > 0 ? up : down;
    unit.divisor *= power > 0 ? down : up;
    for (std::size_t i = 0; i < unit.powers.size(); ++i) unit.powers[i] += power * found->powers[i];
  }

  static std::string_view without_superscript(std::string_view symbol) {
    for (const std::string_view mark : {"²", "³", "·"})
      symbol = symbol.substr(0, symbol.find(mark));
    return symbol;
  }

  /// An integer of one digit with or without ^ before it; 1 if there is none.
  int take_power() {
    if (take("²")) return 2;
    if (take("³")) return 3;
    const bool caret = take("^");
    const bool minus = take("-");
    if (!rest_.empty() && rest_[0] >= '1' && rest_[0] <= '9') {
      const int digit = rest_[0] - '0';
      rest_.remove_prefix(1);
      if (rest_.empty() || rest_[0] < '0' || rest_[0] > '9') return minus ? -digit : digit;
    } else if (!caret && !minus) {
      return 1;
    }
    fail(whole_, ", where a power is not an integer from -9 to 9", expected_);
  }

  [[noreturn]] void fail_unknown(std::string_view name) {
    std::vector<std::string_view> known;
    known.reserve(kSymbols.size());
    for (const Symbol& symbol : kSymbols) known.push_back(symbol.text);
    const std::string closest = closest_word(name, known);
    throw UnitError(fmt::format(
        "got \"{}\", unknown unit \"{}\"; expected {} ({}){}", whole_, name, expected_.name,
        expected_.units, closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)));
  }

  std::string_view whole_;
  std::string_view rest_;
  const Dimension& expected_;
};

}  // namespace

double parse_quantity(std::string_view text, const Dimension& expected) {
  const std::string_view body = trimmed(text);
  std::string_view digits = body;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::result_out_of_range) fail(text, ", which no double can hold", expected);
  if (error != std::errc() || (body != digits && number < 0.0))
    fail(text, ", which does not begin with a number", expected);
  std::string_view unit_text =
      trimmed(std::string_view(end, static_cast<std::size_t>(digits.data() + digits.size() - end)));
  if (unit_text.starts_with(',')) fail(text, ", where the decimal sign must be a point", expected);
  if (!std::isfinite(number)) fail(text, ", which is not finite", expected);
  if (unit_text.empty()) return number;

  const Unit unit = UnitParser(text, unit_text, expected).parse();
  if (unit.powers != expected.powers) fail(text, ", " + name_of(unit.powers), expected);
  const double value = number * unit.multiplier / unit.divisor;
  if (!std::isfinite(value)) fail(text, ", which no double can hold", expected);
  return value;
}

}  // namespace plekton::apps
