#pragma once

#include <vector>

#include "core/vec.h"

namespace interflect::solvers {

/// Unknown a <-> (element, basis function): the unknowns of element e are first_of_element[e] .. first_of_element[e +
/// 1].
struct Layout {
  std::vector<Index> first_of_element;   ///< size: elements + 1
  Index owned_begin = 0, owned_end = 0;  ///< unknowns of this process; all of them without MPI

  static Layout uniform(Index elements, Index functions_each);
  Index elements() const { return static_cast<Index>(first_of_element.size()) - 1; }
  Index unknowns() const { return first_of_element.back(); }
  bool constants() const { return unknowns() == elements(); }  ///< one function an element
  Index element_of(Index unknown) const;
};

}  // namespace interflect::solvers
