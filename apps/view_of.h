#pragma once

#include <filesystem>
#include <string>

#include "apps/factor_request.h"

namespace interflect::apps {

/// Of every element the view factor to one surface, sum_{s in S} F_js, the share of j's view that S fills, with the sum
/// of its entries' errors.
class ViewOf {
 public:
  /// @param name  of a side of a surface ("lamp", "plate/back"), or a group
  /// @throws core::InputError  there is none: with those that there are, if few
  ViewOf(const std::string& name, const FactorRequest& request);

  /// F.view.vtu beside F.h5, with row sums and errors, and F.view.png where VTK was built in: from the scene's first
  /// camera, or from outside.
  void write(const std::filesystem::path& out, const results::FactorStore& store) const;

 private:
  std::string name_;
  const FactorRequest& request_;
  std::vector<Index> seen_;  ///< elements of the surface
};

}  // namespace interflect::apps
