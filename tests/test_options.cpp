// The option table: complete, in range, read and written without loss.
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

#include "inkgrid/inkgrid.h"
#include "options.h"
#include "printing.h"

namespace inkgrid {
namespace {

class EachOption : public ::testing::TestWithParam<OptionRow> {
 protected:
  void expect_refused(const std::string& text) {
    Options options;
    try {
      set_option(options, GetParam(), text);
      ADD_FAILURE() << GetParam().name << " took '" << text << "'";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      EXPECT_NE(std::string(error.what()).find(GetParam().name), std::string::npos) << error.what();
    }
    for (const OptionRow& row : option_table())
      EXPECT_TRUE(is_default(options, row)) << row.name << " changed with '" << text << "'";
  }

  bool has_names() const { return is_name(GetParam()); }
  bool is_count() const { return std::holds_alternative<int Options::*>(GetParam().member); }
};

std::string number(double value) {
  std::ostringstream text;
  text << std::setprecision(12) << value;
  return text.str();
}

TEST_P(EachOption, IsDescribed) {
  const OptionRow& row = GetParam();
  EXPECT_LT(row.least, row.most);
  EXPECT_FALSE(row.help.empty());
  EXPECT_NE(row.help.back(), '.');
  EXPECT_EQ(row.help.find('\n'), std::string::npos);
  EXPECT_EQ(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
}

TEST_P(EachOption, DefaultGoesRound) {
  Options options;
  const std::string text = option_text(options, GetParam());
  set_option(options, GetParam(), text);
  EXPECT_TRUE(is_default(options, GetParam())) << text;
}

TEST_P(EachOption, EndsOfTheRangeGoRoundAndChangeNothingElse) {
  if (has_names()) return;  // its values are names
  for (const double end : {GetParam().least, GetParam().most}) {
    Options options;
    set_option(options, GetParam(), is_count() ? std::to_string(std::lround(end)) : number(end));
    EXPECT_DOUBLE_EQ(std::stod(option_text(options, GetParam())), end);
    EXPECT_NO_THROW(validate(options));
    for (const OptionRow& row : option_table()) EXPECT_TRUE(row.name == GetParam().name || is_default(options, row)) << row.name;
  }
}

TEST_P(EachOption, RefusesWhatIsOutsideItsRange) {
  expect_refused(number(std::ceil(GetParam().most) + 1));
  expect_refused(number(std::floor(GetParam().least) - 1));
  expect_refused("1e999");
}

TEST_P(EachOption, RefusesWhatIsNoValue) {
  for (const char* text : {"", " ", "nan", "inf", "-inf", "seven", "0,5", "0.5 ", " 0.5", "0.5x", "0x1p-1", "AUTO", "--"})
    expect_refused(text);
  if (is_count()) expect_refused("1.5");
}

TEST_P(EachOption, TakesAutoOnlyWhereItMayBeUnset) {
  Options options;
  if (std::holds_alternative<std::optional<double> Options::*>(GetParam().member)) {
    set_option(options, GetParam(), number(std::ceil(GetParam().least)));
    EXPECT_FALSE(is_default(options, GetParam()));
    set_option(options, GetParam(), "auto");
    EXPECT_EQ(option_text(options, GetParam()), "auto");
  } else if (!has_names()) {
    expect_refused("auto");
  }
}

TEST_P(EachOption, ValidateFindsAValueSetPastTheTable) {
  const double wrong[] = {GetParam().most + 1, GetParam().least - 1, std::numeric_limits<double>::quiet_NaN()};
  for (const double value : wrong) {
    Options options;
    if (const auto* real = std::get_if<double Options::*>(&GetParam().member)) options.** real = value;
    if (const auto* maybe = std::get_if<std::optional<double> Options::*>(&GetParam().member)) options.** maybe = value;
    if (const auto* count = std::get_if<int Options::*>(&GetParam().member))
      options.** count = std::isnan(value) ? -1 : static_cast<int>(value);
    const int enumerator = std::isnan(value) ? 7 : static_cast<int>(value);
    if (const auto* preset = std::get_if<Preset Options::*>(&GetParam().member))
      options.** preset = static_cast<Preset>(enumerator);
    if (const auto* fills = std::get_if<FillMode Options::*>(&GetParam().member))
      options.** fills = static_cast<FillMode>(enumerator);
    if (const auto* bundles = std::get_if<BundleMode Options::*>(&GetParam().member))
      options.** bundles = static_cast<BundleMode>(enumerator);
    EXPECT_THROW(validate(options), Error) << value;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, EachOption, ::testing::ValuesIn(option_table().begin(), option_table().end()));

TEST(OptionTable, CoversEveryMemberOnce) {
  std::set<std::string_view> names;
  std::size_t bytes = 0;
  for (const OptionRow& row : option_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    bytes += std::visit([](auto Options::*m) { return sizeof(Options{}.*m); }, row.member);
  }
  // Padding is less than a member: a member without a row would leave a larger hole.
  EXPECT_LE(sizeof(Options) - bytes, 3 * sizeof(int));
}

TEST(OptionTable, MembersAreDistinct) {
  for (const OptionRow& row : option_table()) {
    Options options;
    if (is_name(row))
      set_option(options, row, accepted_values(row).substr(accepted_values(row).rfind(' ') + 1));  // the last of them
    else
      set_option(options, row, option_text(options, row) == number(row.least) ? "1" : number(row.least));
    for (const OptionRow& other : option_table())
      EXPECT_EQ(is_default(options, other), other.name != row.name) << row.name << " " << other.name;
  }
}

TEST(OptionTable, KnowsNoOtherName) {
  for (const char* name : {"", "nothing", "--snap", "Snap"}) EXPECT_THROW(option_row(name), Error) << name;
  EXPECT_EQ(option_row("snap").name, "snap");
}

TEST(OptionTable, HasTheConstantsOfThePaper) {
  const Options paper;
  const auto text = [&](const char* name) { return option_text(paper, option_row(name)); };
  EXPECT_EQ(text("snap"), "25");
  EXPECT_EQ(text("snap-sigma"), "0.1");
  EXPECT_EQ(text("damping"), "0.0001");
  EXPECT_EQ(text("label-length"), "4");
  EXPECT_EQ(text("label-ratio"), "0.48");
  EXPECT_EQ(text("merge-difference"), "0.5");
  EXPECT_EQ(text("degenerate-angle"), "30");
  EXPECT_EQ(text("degenerate-ratio"), "0.1");
  EXPECT_EQ(text("degenerate-fraction"), "0.01");
  EXPECT_EQ(text("field-rounds"), "100");
  EXPECT_EQ(text("mesh-size"), "0.25");
  EXPECT_EQ(text("coverage-bins"), "4");
  EXPECT_EQ(text("preset"), "auto");
  EXPECT_EQ(text("threshold"), "auto");
  EXPECT_EQ(text("fills"), "layer");
  EXPECT_EQ(text("bundles"), "auto");
  EXPECT_EQ(text("gap"), "auto");
}

TEST(OptionTable, PresetsHaveNames) {
  Options options;
  set_option(options, option_row("preset"), "clean");
  EXPECT_EQ(options.preset, Preset::clean);
  set_option(options, option_row("preset"), "rough");
  EXPECT_EQ(options.preset, Preset::rough);
  set_option(options, option_row("preset"), "auto");
  EXPECT_EQ(options.preset, Preset::automatic);
}

TEST(OptionTable, NamesAreThoseOfTheEnumerators) {
  Options options;
  for (const auto& [name, mode] : {std::pair{"drop", FillMode::drop}, {"trace", FillMode::trace}, {"layer", FillMode::layer}}) {
    set_option(options, option_row("fills"), name);
    EXPECT_EQ(options.fills, mode);
  }
  for (const auto& [name, mode] :
       {std::pair{"join", BundleMode::join}, {"keep", BundleMode::keep}, {"auto", BundleMode::automatic}}) {
    set_option(options, option_row("bundles"), name);
    EXPECT_EQ(options.bundles, mode);
  }
  EXPECT_EQ(accepted_values(option_row("fills")), "layer, drop or trace");
  EXPECT_EQ(accepted_values(option_row("bundles")), "auto, join or keep");
  EXPECT_EQ(accepted_values(option_row("preset")), "auto, clean or rough");
}

TEST(CommandLineText, TellsOnlyWhatDiffers) {
  Options options;
  EXPECT_EQ(command_line_text(options), "");
  options.spacing = 2.5;
  options.threshold = 165;
  options.preset = Preset::rough;
  EXPECT_EQ(command_line_text(options), "--preset rough --threshold 165 --spacing 2.5");
}

TEST(OptionText, ReadsBackEveryBit) {
  for (const double value : {0.1, 1.0 / 3, 0.30000000000000004, 1e-7}) {
    Options options;
    options.reach = value;
    const std::string text = option_text(options, option_row("reach"));
    Options read;
    set_option(read, option_row("reach"), text);
    EXPECT_EQ(*read.reach, value) << text;
  }
}

TEST(Error, NamesWhatIsAccepted) {
  Options options;
  try {
    set_option(options, option_row("threshold"), "300");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "threshold must be a number from 0 to 255 or auto, not '300'");
  }
}

}  // namespace
}  // namespace inkgrid
