#include "solvers/layout.h"

#include <algorithm>
#include <cassert>

namespace interflect::solvers {

Layout Layout::uniform(Index elements, Index functions_each) {
  Layout layout;
  layout.first_of_element.resize(static_cast<std::size_t>(elements) + 1);
  for (Index e = 0; e <= elements; ++e) layout.first_of_element[static_cast<std::size_t>(e)] = e * functions_each;
  layout.owned_end = elements * functions_each;
  return layout;
}

Index Layout::element_of(Index unknown) const {
  assert(unknown >= 0 && unknown < unknowns());
  const auto after = std::upper_bound(first_of_element.begin(), first_of_element.end(), unknown);
  return after - first_of_element.begin() - 1;
}

}  // namespace interflect::solvers
