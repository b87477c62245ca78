#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/apps/factor_tables.h"
#include "tests/apps/program.h"
#include "tests/support/vtu_values.h"

namespace interflect::test {
namespace {

// The unit cube's walls, seen from inside.
const std::string cube =
    "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv 1 1 0\nv 1 1 1\n"
    "g low\nf 3 4 2 1\nf 6 8 7 5\ng high\nf 2 6 5 1\nf 7 8 4 3\nf 5 7 3 1\nf 4 8 6 2\n";

TEST(ViewFactors, of_the_cube_are_the_known_ones_within_their_errors) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube), out = folder / "F.csv";
  const Outcome run = interflect({"view-factors", mesh, "-o", out, "--tolerance", "1e-6"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "from 1.000000 to 1.000000")) << run.out;
  const auto F = entries_of(read_file(out));
  EXPECT_EQ(F.size(), 30u);
  for (const auto& [pair, entry] : F) {
    const bool opposite = std::stoi(pair.first) / 2 == std::stoi(pair.second) / 2;
    const double exact = opposite ? 0.19982489569838738 : 0.20004377607540315;
    EXPECT_NEAR(entry.F, exact, entry.error + 1e-15);
    EXPECT_LT(entry.error, 1e-6);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "F.h5"));
}

TEST(ViewFactors, are_written_in_every_format_and_summed_by_group) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube);
  for (const char* name : {"F.h5", "F.npz", "F.mtx"})
    EXPECT_EQ(interflect({"view-factors", mesh, "-o", folder / name, "--element-size", "0.5"}).status, 0) << name;
  EXPECT_TRUE(contains(read_file(folder / "F.mtx"), "%%MatrixMarket matrix coordinate real general"));
  ASSERT_EQ(interflect({"view-factors", mesh, "-o", folder / "G.csv", "--whole-groups", "--groups", "group"}).status,
            0);
  const std::string table = read_file(folder / "G.csv");
  EXPECT_TRUE(contains(table, "from,to,F,error")) << table;
  const auto G = entries_of(table);
  ASSERT_EQ(G.size(), 4u) << table;
  double low = 0;
  for (const auto& [pair, entry] : G)
    if (contains(pair.first, "low")) low += entry.F;
  EXPECT_NEAR(low, 1, 1e-4);
}

/// Sums of rows, what reaches no element among them, and the largest error of an entry between elements.
struct Rows {
  std::map<std::string, double> sum, environment;
  double largest_error = 0;
};
Rows rows_of(const std::string& csv) {
  Rows rows;
  for (const auto& [pair, entry] : entries_of(csv)) {
    rows.sum[pair.first] += entry.F;
    if (pair.second == "environment") {
      rows.environment[pair.first] = entry.F;
      EXPECT_GT(entry.error, 0);
    } else {
      rows.largest_error = std::max(rows.largest_error, entry.error);
    }
  }
  return rows;
}

// The cube without its last wall, which the floor opposite would send 0.1998 to and the others 0.2000.
TEST(ViewFactors, are_repaired_on_request_with_the_environment_as_a_column) {
  const TemporaryFolder folder;
  const std::string open = folder.write("open.obj", cube.substr(0, cube.rfind("f 4"))),
                    closed = folder.write("cube.obj", cube);
  for (const char* closure : {"scaling", "least-squares"})
    for (const char* method : {"analytic", "hemisphere-rays"}) {
      const bool exact = std::string(method) == "analytic";
      const std::string out = folder / (std::string(closure) + method + ".csv");
      const auto command_of = [&](const std::string& mesh, const std::string& to, const char* tolerance) {
        std::vector<std::string> words{"view-factors",   mesh,   "-o",          to,       "--closure", closure,
                                       "--form-factors", method, "--tolerance", tolerance};
        if (!exact) words.insert(words.end(), {"--samples", "4096"});
        return words;
      };
      const std::vector<std::string> command = command_of(open, out, exact ? "1e-7" : "0.1");
      const Outcome run = interflect(command);
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_TRUE(contains(run.out, " of what leaves reaches no element")) << run.out;
      const Rows rows = rows_of(read_file(out));
      ASSERT_EQ(rows.environment.size(), 5u);
      for (const auto& [i, sum] : rows.sum) {
        EXPECT_NEAR(sum, 1, 1e-12) << i;
        EXPECT_NEAR(rows.environment.at(i), i == "4" ? 0.19982489569838738 : 0.20004377607540315, exact ? 1e-6 : 0.02);
      }
      EXPECT_LT(rows.largest_error, exact ? 1e-7 : 0.05);
      const Outcome again = interflect(command);
      EXPECT_TRUE(contains(again.out, "has them already"));
      EXPECT_EQ(again.status, 0) << "the tolerance is asked of what was computed";
      EXPECT_EQ(interflect(command_of(closed, folder / "C.csv", "0.1")).status, 0);
      for (const auto& [i, sum] : rows_of(read_file(folder / "C.csv")).sum) EXPECT_NEAR(sum, 1, 1e-12) << i;
      EXPECT_FALSE(contains(read_file(folder / "C.csv"), "environment")) << "it is closed";
    }
}

// The two walls of a group: what one sees of the other, and what all others see of both.
TEST(ViewFactors, to_one_surface_are_drawn_with_their_errors) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube);
  ASSERT_EQ(interflect({"view-factors", mesh, "-o", folder / "F.csv", "--view-of", "low"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "F.h5"));
  const std::string vtu = read_file(folder / "F.view.vtu");
  const std::vector<double> F = values<double>(vtu, "view_factor"), error = values<double>(vtu, "view_factor_error");
  ASSERT_EQ(F.size(), 6u);
  for (std::size_t j = 0; j < 6; ++j) {
    const double exact = j < 2 ? 0.19982489569838738 : 2 * 0.20004377607540315;
    EXPECT_NEAR(F[j], exact, error[j] + 1e-15);
    EXPECT_LT(error[j], 1e-4);
    EXPECT_NEAR(values<double>(vtu, "row_sum")[j], 1, 1e-4);
  }
  const Outcome none = interflect({"view-factors", mesh, "-o", folder / "G.csv", "--view-of", "lamp"});
  EXPECT_EQ(none.status, 2);
  EXPECT_TRUE(contains(
      none.err, "--view-of lamp: no surface or group of that name has view factors; groups: high, low; surfaces: "))
      << none.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "G.h5"));
}

// Computed once, used by a solve: the same solution as one that computes them, to the tolerance; of another geometry
// they are refused.
TEST(ViewFactors, serve_a_solve_of_the_same_geometry_and_no_other) {
  const TemporaryFolder folder;
  const std::string factors = folder / "F.h5";
  ASSERT_EQ(interflect({"view-factors", shipped_scene("cube"), "--element-size", "0.25", "-o", factors}).status, 0);
  const auto mean_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{
        "solve", shipped_scene("cube"), "--element-size", "0.25", "--no-pictures", "--json", "-o", folder / "out"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome solve = interflect(command);
    EXPECT_EQ(solve.status, 0) << solve.err;
    return nlohmann::json::parse(solve.out).at("form_factors").at("row_sum_mean").get<double>();
  };
  EXPECT_NEAR(mean_of({"--factors", factors}), mean_of({"--form-factors", "analytic"}), 1e-4);
  const Outcome other = interflect({"solve", shipped_scene("cube"), "--element-size", "0.5", "--no-pictures", "-o",
                                    folder / "other", "--factors", factors});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(contains(other.err,
                       "F.h5: it has the view factors of 96 elements, and the scene is cut into 24: the "
                       "--element-size of that run, and the same scene, expected"))
      << other.err;
}

// What the heater gives, less what the walls take, goes into the load and out of the door.
TEST(Exchange, of_the_oven_balances) {
  const TemporaryFolder folder;
  const Outcome run = interflect({"exchange", shipped_scene("oven"), "-o", folder / "out", "--environment", "293.15",
                                  "--element-size", "0.2", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto said = nlohmann::json::parse(run.out);
  const double net = said.at("net_flux_W"), out = said.at("to_environment_W");
  EXPECT_GT(net, 1000);
  EXPECT_NEAR(net / out, 1, 0.02);
  for (const auto& s : said.at("surfaces")) {
    if (s.at("name") == "heater") {
      EXPECT_GT(s.at("temperature"), 600);
      EXPECT_GT(s.at("temperature_error"), 0);
    }
  }
  EXPECT_TRUE(
      contains(read_file(folder / "out/exchange.csv"), "name,area,emissivity,temperature,temperature_error,heat_flux"));
  const std::string vtu = read_file(folder / "out/exchange.vtu");
  const std::vector<double> T = values<double>(vtu, "temperature"), B = values<double>(vtu, "radiosity"),
                            H = values<double>(vtu, "irradiance"), q = values<double>(vtu, "heat_flux");
  ASSERT_EQ(T.size(), said.at("elements").get<std::size_t>());
  for (std::size_t i = 0; i < T.size(); ++i) {
    EXPECT_GT(T[i], 293);
    EXPECT_NEAR(q[i], B[i] - H[i], 1e-6 * B[i]);
  }
  EXPECT_TRUE(said.at("form_factors").at("tolerance_met").get<bool>());
  const Outcome rough = interflect({"exchange", shipped_scene("oven"), "-o", folder / "rough", "--element-size", "0.2",
                                    "--no-pictures", "--form-factors", "hemisphere-rays", "--samples", "400",
                                    "--tolerance", "1e-6", "--closure", "scaling", "--json", "--quiet"});
  EXPECT_EQ(rough.status, 1);
  EXPECT_TRUE(contains(rough.err, "less accurate than asked: sum_j |dF_ij| is up to ")) << rough.err;
  EXPECT_TRUE(contains(rough.err, ", 1.0e-06 asked for")) << rough.err;
  EXPECT_GT(nlohmann::json::parse(rough.out).at("form_factors").at("closure_correction").get<double>(), 0);
  const Outcome lit = interflect({"exchange", shipped_scene("cube"), "-o", folder / "lit"});
  EXPECT_EQ(lit.status, 2);
  EXPECT_TRUE(contains(lit.err,
                       "cube.json: an exchange needs an emissivity, with a temperature or a heat_flux, of every "
                       "material: missing of '"))
      << lit.err;
}

TEST(CompareFormFactors, holds_every_method_against_the_exact_one) {
  const TemporaryFolder folder;
  const Outcome run = interflect(
      {"compare-form-factors", shipped_scene("cube"), "--element-size", "0.5", "-o", folder / "out", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto methods = nlohmann::json::parse(run.out).at("methods");
  std::set<std::string> names;
  for (const auto& m : methods) {
    names.insert(m.at("method").get<std::string>());
    EXPECT_NE(m.at("setting"), "") << m.at("method");
    if (m.at("method") == "analytic" && m.at("setting") == "tolerance 0.001") {
      EXPECT_LT(m.at("largest_row_error"), 1e-3);
    }
    EXPECT_GE(m.at("largest_row_error"), m.at("mean_row_error").get<double>() * (1 - 1e-12));
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"analytic", "area-to-area", "duffy", "gauss-lambert", "global-lines", "hemicube",
                                   "hemicube-max", "hemicube-midpoint", "hemisphere-rays", "hybrid", "single-plane"}));
  EXPECT_TRUE(contains(read_file(folder / "out/form_factors.csv"), "method,setting,seconds,"));
  const std::string told =
      interflect({"compare-form-factors", shipped_scene("cube"), "--element-size", "1", "-o", folder / "out"}).out;
  const std::string row = "hemicube-max       resolution 512";
  const auto first = told.find(row);
  ASSERT_NE(first, std::string::npos) << told;
  EXPECT_EQ(told.find(row, first + 1), std::string::npos) << "a row once: " << told;
}

TEST(Scenes, are_expected_where_a_mesh_does_not_do) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube);
  for (const char* command : {"exchange", "compare-form-factors", "solve"}) {
    const Outcome run = interflect({command, mesh, "-o", folder / "out"});
    EXPECT_EQ(run.status, 2);
    EXPECT_TRUE(contains(run.err, "cube.obj: a scene file (.json) is expected, which gives surfaces their materials"))
        << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

TEST(ViewFactors, of_a_dark_scene_need_no_light) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("dark.json", R"({"format": "interflect/scene/1", "units": "m",
    "materials": {"grey": {"reflectance": 0.5}},
    "geometry": [{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "facing": "inward", "material": "grey"}]})");
  const Outcome factors = interflect({"view-factors", scene, "-o", folder / "F.csv"});
  EXPECT_EQ(factors.status, 0);
  EXPECT_FALSE(contains(factors.err, "nothing emits")) << factors.err;
  EXPECT_TRUE(contains(interflect({"info", scene}).err, "nothing emits"));
}

// What a stopped run has written is not computed again, and the result is that of a run that was not stopped.
TEST(ViewFactors, of_a_stopped_run_go_on) {
  const TemporaryFolder folder;
  const std::vector<std::string> command{"view-factors", shipped_scene("concentric_cubes"), "--element-size", "0.12"};
  const auto to = [&](const std::string& out, const std::string& threads = "2") {
    std::vector<std::string> whole = command;
    whole.insert(whole.end(), {"-o", out, "--threads", threads});
    return whole;
  };
  const Outcome stopped = interflect(to(folder / "F.h5", "1"), {.interrupt_when = some_tiles});
  EXPECT_EQ(stopped.status, 1) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "F.h5"));
  EXPECT_TRUE(contains(stopped.err, "F.h5.partial: the same command goes on from there")) << stopped.err;
  const Outcome rest = interflect(to(folder / "F.h5"));
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_TRUE(contains(rest.out, "going on with ")) << rest.out;
  ASSERT_EQ(interflect(to(folder / "G.h5")).status, 0);
  for (const char* name : {"F", "G"}) {
    std::vector<std::string> as_table = to(folder / (std::string(name) + ".csv"));
    as_table.insert(as_table.end(), {"--groups", "surface"});
    ASSERT_EQ(interflect(as_table).status, 0);
  }
  EXPECT_EQ(read_file(folder / "F.csv"), read_file(folder / "G.csv"));
}

TEST(ViewFactors, of_what_is_none_are_refused_in_one_line) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", cube);
  for (const auto& [arguments, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"view-factors", folder / "none.stl", "-o", folder / "F.h5"}, "none.stl"},
           {{"view-factors", mesh, "-o", folder / "F.txt"}, "one of .h5, .npz, .mtx, .csv expected"},
           {{"view-factors", mesh, "-o", folder / "F.h5", "--groups", "group"}, "--groups writes .csv"},
           {{"view-factors", mesh, "-o", folder / "F.h5", "--units", "parsec"}, "parsec"},
           {{"view-factors", mesh, "-o", folder / "F.h5", "--only-occlude", "lamp"}, "lamp"},
           {{"view-factors", mesh, "-o", folder / "F.h5", "--only-occlude", "high", "--leave-out", "high"},
            "'high' is to occlude only, and to be left out"}}) {
    const Outcome run = interflect(arguments);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_TRUE(contains(run.err, said)) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "F.h5"));
  }
}

}  // namespace
}  // namespace interflect::test
