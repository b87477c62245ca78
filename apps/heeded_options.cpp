#include "apps/heeded_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "fem/form_factor/method.h"
#include "solvers/solver.h"

namespace interflect::apps {
namespace {

using solvers::SolverEntry;

bool is_given(const CLI::App& command, const char* name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return option && !option->empty();
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Of how form factors are found.
constexpr const char* of_form_factors[] = {"--form-factors", "--quadrature-tolerance", "--samples",
                                           "--resolution",   "--visibility-rays",      "--visibility-error"};

struct MethodOption {
  const char* name;
  fem::Setting setting;
};
constexpr MethodOption of_methods[] = {{"--samples", fem::Setting::samples},
                                       {"--resolution", fem::Setting::resolution},
                                       {"--visibility-rays", fem::Setting::rays},
                                       {"--visibility-error", fem::Setting::rays}};

/// Of the methods that a setting changes something of: "hemicube, single-plane".
std::string methods_that_heed(fem::Setting setting) {
  std::vector<std::string> names;
  for (const std::string& name : fem::form_factor_names())
    if (fem::setting_of(name) == setting) names.push_back(name);
  return listed(names);
}

void require_heeded_by_method(const CLI::App& command, const std::string& method) {
  for (const auto& [name, setting] : of_methods)
    if (is_given(command, name) && fem::setting_of(method) != setting)
      throw CLI::ValidationError(
          name, "form factors by " + method + " do not heed it: --form-factors " + methods_that_heed(setting));
}

/// Where view factors come from a file, settings of how they are found change nothing.
void require_computed(const CLI::App& command) {
  if (!is_given(command, "--factors")) return;
  for (const char* name : of_form_factors)
    if (is_given(command, name))
      throw CLI::ValidationError(name, "the view factors of a file do not heed it: without it, or without --factors");
}

bool samples(const SolverEntry& solver) { return solver.samples(); }
bool has_residual(const SolverEntry& solver) { return !solver.samples(); }
bool relaxes(const SolverEntry& solver) { return solver.name == "over-relaxation"; }
bool overshoots(const SolverEntry& solver) { return solver.name == "progressive"; }
bool shoots(const SolverEntry& solver) { return overshoots(solver) || solver.name == "southwell"; }

struct SolverOption {
  const char* name;
  bool (*heeds)(const SolverEntry&);
};
constexpr SolverOption of_solvers[] = {{"--noise", samples},      {"--sequence", samples},
                                       {"--unshot", shoots},      {"--solver-tolerance", has_residual},
                                       {"--relaxation", relaxes}, {"--overshoot", overshoots}};

/// The solvers that were asked for, or the one that is taken where none is; none where all are taken.
std::vector<std::string> chosen(const CLI::Option& option) {
  if (!option.empty()) return option.results();
  return option.get_default_str().empty() ? std::vector<std::string>() : std::vector{option.get_default_str()};
}

/// @param whole  of those whose answer is all of the solution
std::string solvers_that(bool (*heeds)(const SolverEntry&), bool whole) {
  std::vector<std::string> names;
  for (const SolverEntry& each : solvers::known_solvers())
    if (heeds(each) && !(whole && each.needs == SolverEntry::Needs::target)) names.push_back(each.name);
  return listed(names);
}

void require_heeded_by_solvers(const CLI::App& command) {
  const CLI::Option *one = command.get_option_no_throw("--solver"), *some = command.get_option_no_throw("--solvers");
  const CLI::Option* option = one ? one : some;
  if (!option) return;
  const std::vector<std::string> names = chosen(*option);
  const auto any = [&](bool (*heeds)(const SolverEntry&)) {
    return names.empty() || std::any_of(names.begin(), names.end(),
                                        [&](const std::string& name) { return heeds(solvers::solver_named(name)); });
  };
  for (const auto& [name, heeds] : of_solvers)
    if (is_given(command, name) && !any(heeds))
      throw CLI::ValidationError(name, (names.size() > 1 ? "none of " : "") + listed(names) +
                                           (names.size() > 1 ? " heeds it: " : " does not heed it: ") +
                                           option->get_name() + " " + solvers_that(heeds, option == one));
  if (!one || !samples(solvers::solver_named(names.front()))) return;  // the others are compared on a matrix
  for (const char* name : of_form_factors)
    if (is_given(command, name))
      throw CLI::ValidationError(name, names.front() + " works by rays, without form factors, and does not heed it: " +
                                           one->get_name() + " " + solvers_that(has_residual, true));
}

}  // namespace

void refuse_what_is_not_heeded(CLI::App& command, const std::string& form_factors) {
  command.parse_complete_callback([&command, &form_factors] {
    require_computed(command);
    require_heeded_by_solvers(command);
    require_heeded_by_method(command, form_factors);
  });
}

}  // namespace interflect::apps
