#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace interflect::apps {

/// Refuses, once all options are read, those that change nothing: of form factors, what the method does not heed, nor a
/// file of them, nor a solver that has none; of solvers, what none of those asked for heeds.  Who does is named.
/// @param form_factors  the method, which other options may choose; it outlives the parser
void refuse_what_is_not_heeded(CLI::App& command, const std::string& form_factors);

}  // namespace interflect::apps
