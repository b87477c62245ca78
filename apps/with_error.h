#pragma once

#include <string>

namespace interflect::apps {

/// "-10280 +- 110": a value to the place of the second digit of its error, for people.  The error is rounded up and has
/// what rounding did to the value in it, so that the interval holds what the whole numbers' one does.
std::string with_error(double value, double error);

}  // namespace interflect::apps
