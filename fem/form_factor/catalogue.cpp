#include <algorithm>

#include "core/error.h"
#include "fem/form_factor/analytic.h"
#include "fem/form_factor/analytic_moments.h"
#include "fem/form_factor/area_to_area.h"
#include "fem/form_factor/duffy.h"
#include "fem/form_factor/gauss_lambert.h"
#include "fem/form_factor/global_lines.h"
#include "fem/form_factor/hemicube.h"
#include "fem/form_factor/hemisphere_rays.h"
#include "fem/form_factor/hybrid.h"
#include "fem/form_factor/sampled_moments.h"
#include "fem/form_factor/single_plane.h"

namespace interflect::fem {

namespace {

struct Entry {
  const char* name;
  std::unique_ptr<FormFactorMethod> (*make)(const FormFactorContext&);
  Setting setting;
};

template <class Method>
std::unique_ptr<FormFactorMethod> make(const FormFactorContext& context) {
  return std::make_unique<Method>(context);
}

std::unique_ptr<FormFactorMethod> make_analytic(const FormFactorContext& context) {
  return context.order == 0 ? make<Analytic>(context) : make<AnalyticMoments>(context);
}

std::unique_ptr<FormFactorMethod> make_gauss_lambert(const FormFactorContext& context) {
  return context.order == 0 ? make<GaussLambert>(context) : make<SampledMoments>(context);
}

constexpr Entry catalogue[] = {{"analytic", make_analytic, Setting::tolerance},
                               {"hybrid", make<Hybrid>, Setting::tolerance},
                               {"gauss-lambert", make_gauss_lambert, Setting::rays},
                               {"duffy", make<Duffy>, Setting::rays},
                               {"area-to-area", make<AreaToArea>, Setting::samples},
                               {"hemisphere-rays", make<HemisphereRays>, Setting::samples},
                               {"global-lines", make<GlobalLines>, Setting::samples},
                               {"hemicube", make<ExactHemicube>, Setting::resolution},
                               {"hemicube-midpoint", make<MidpointHemicube>, Setting::resolution},
                               {"hemicube-max", make<MaxHemicube>, Setting::resolution},
                               {"single-plane", make<SinglePlane>, Setting::resolution}};

const Entry& entry_of(const std::string& name) {
  std::string known;
  for (const Entry& entry : catalogue) {
    if (name == entry.name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw core::InputError("form factors by '" + name + "'", "one of " + known + " expected");
}

}  // namespace

PairCounts& PairCounts::operator+=(const PairCounts& o) {
  facing_away += o.facing_away;
  clear += o.clear;
  sampled += o.sampled;
  rays += o.rays;
  subtracted += o.subtracted;
  points += o.points;
  clamped += o.clamped;
  lost = std::max(lost, o.lost);
  return *this;
}

std::unique_ptr<FormFactorMethod> make_form_factor_method(const std::string& name, const FormFactorContext& context) {
  auto method = entry_of(name).make(context);
  if (method->highest_order() < context.order)
    throw core::InputError("form factors by '" + name + "'",
                           "they are of constants: --order 0, or analytic, gauss-lambert or duffy, expected");
  return method;
}

Setting setting_of(const std::string& name) { return entry_of(name).setting; }

std::vector<std::string> form_factor_names() {
  std::vector<std::string> names;
  for (const Entry& entry : catalogue) names.emplace_back(entry.name);
  return names;
}

}  // namespace interflect::fem
