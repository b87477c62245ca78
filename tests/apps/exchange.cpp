#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/apps/csv_table.h"
#include "tests/apps/program.h"
#include "tests/support/vtu_values.h"

namespace interflect::test {
namespace {

using nlohmann::json;

/// A grey box heated by 900 W/m² in the middle of a black room at 300 K, in which it sees nothing else: sigma T^4 =
/// 300^4 sigma + q / e, B = 300^4 sigma + q.  Its area is 6 m², that of the walls 24.
const char* const box_in_a_room = R"({ "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "materials": { "heated": { "emissivity": 0.6, "heat_flux": 900 }, "wall": { "emissivity": 1, "temperature": 300 } },
  "geometry": [
    { "name": "body", "material": "heated", "box": { "min": [-0.5,-0.5,-0.5], "max": [0.5,0.5,0.5] } },
    { "name": "room", "material": "wall", "facing": "inward", "box": { "min": [-1,-1,-1], "max": [1,1,1] } } ] })";

constexpr double sigma = 5.670374419e-8, at_300 = sigma * 300 * 300 * 300 * 300;

// Every number that was found has its error, and the truth is within it: 2.2 half widths are 4.3 standard errors of
// noise, which one of some 40 values exceeds with a probability of 7e-4.
TEST(Exchange, every_number_that_is_found_comes_with_its_error) {
  const TemporaryFolder folder;
  const Outcome run = interflect({"exchange", folder.write("box.json", box_in_a_room), "-o", folder / "out",
                                  "--element-size", "0.5", "--no-pictures", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const CsvTable table(folder / "out/exchange.csv");
  const auto expect = [&](const std::string& name, const std::string& what, double truth) {
    const double error = table.at(name, what + "_error");
    EXPECT_GT(error, 0) << name << " " << what;
    EXPECT_LT(error, .1 * std::abs(truth)) << name << " " << what;
    EXPECT_NEAR(table.at(name, what), truth, 2.2 * error) << name << " " << what;
  };
  for (const std::string& name : table.names()) {
    const bool body = name.rfind("body", 0) == 0;
    expect(name, "irradiance", at_300 + (body ? 0 : 900. / 4));
    if (body) {
      expect(name, "temperature", std::pow((at_300 + 900 / .6) / sigma, .25));
      expect(name, "radiosity", at_300 + 900);
      EXPECT_EQ(table.at(name, "flux"), 900);
    } else {
      expect(name, "heat_flux", -900. / 4);
      expect(name, "flux", -900);
      EXPECT_NEAR(table.at(name, "flux_error"), 4 * table.at(name, "heat_flux_error"), 1e-9);
    }
    for (const char* given : {body ? "heat_flux" : "temperature", body ? "flux" : "radiosity"})
      EXPECT_EQ(table.at(name, std::string(given) + "_error"), 0) << name << " " << given;
  }
  for (const json& s : json::parse(run.out).at("surfaces"))
    for (const char* what : {"temperature", "heat_flux", "flux", "radiosity", "irradiance"})
      for (const std::string suffix : {"", "_error"}) {
        const double said = s.at(what + suffix);
        EXPECT_NEAR(table.at(s.at("name"), what + suffix), said, 1e-10 * std::abs(said)) << what << suffix;
      }
  const std::string vtu = read_file(folder / "out/exchange.vtu");
  for (const char* what : {"temperature", "heat_flux", "radiosity", "irradiance"})
    EXPECT_EQ(values<double>(vtu, std::string(what) + "_error").size(), values<double>(vtu, what).size()) << what;
}

// "-900.0 +- 2.4": value and error end at the same place, the error in its second digit.
TEST(Exchange, prints_no_more_digits_than_errors_leave) {
  const TemporaryFolder folder;
  const Outcome run = interflect({"exchange", folder.write("box.json", box_in_a_room), "-o", folder / "out",
                                  "--element-size", "0.5", "--no-pictures"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::regex pattern(R"((-?\d+)(\.\d+)? \+- (\d+)(\.\d+)?)");
  int found = 0;
  for (std::sregex_iterator at(run.out.begin(), run.out.end(), pattern), end; at != end; ++at, ++found) {
    const std::smatch& said = *at;
    EXPECT_EQ(said.length(2), said.length(4)) << said.str();
    std::string digits = said.str(3) + (said[4].matched ? said.str(4).substr(1) : "");
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
    if (said[4].matched) {
      EXPECT_LE(digits.size(), 3u) << said.str();
      EXPECT_GE(digits.size(), 2u) << said.str();
    }
  }
  EXPECT_EQ(found, 6 + 2 * 6 + 2) << run.out;  // T of the body's sides; q and Q of the walls; two sums
}

}  // namespace
}  // namespace interflect::test
