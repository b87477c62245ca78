#include "core/error.h"
#include "core/format.h"
#include "fem/form_factor/gauss_lambert.h"

namespace interflect::fem {

PairCounts& PairCounts::operator+=(const PairCounts& o) {
  facing_away += o.facing_away;
  clear += o.clear;
  sampled += o.sampled;
  rays += o.rays;
  clamped += o.clamped;
  return *this;
}

std::unique_ptr<FormFactorMethod> make_form_factor_method(const std::string& name, const FormFactorContext& context) {
  if (name == "gauss-lambert") return std::make_unique<GaussLambert>(context);
  throw core::InputError(core::format("form factors by '%s' are unknown: gauss-lambert expected", name.c_str()));
}

std::vector<std::string> form_factor_names() { return {"gauss-lambert"}; }

}  // namespace interflect::fem
