#pragma once

#include <optional>
#include <span>
#include <string>

#include "fem/goal/adaptation.h"
#include "measure/sensor_points.h"
#include "results/record.h"
#include "scene/scene.h"

namespace interflect::apps {

/// What elements shall be made for.
/// @param name  of a sensor or of a side of a surface, "camera:NAME", or nothing: all sensors
/// @throws core::InputError  with the names known
fem::Goal goal_named(const std::string& name, const scene::Scene& scene, std::span<const measure::SensorPoint> points);

/// What a goal is called: "E_avg(desk)" in lx, or "L_avg(camera:front)" in cd/m2.
struct GoalQuantity {
  std::string name;
  const char* unit;
};
GoalQuantity quantity_of(const fem::Goal& goal, const scene::Scene& scene);

/// How elements came about, as a table, and the goal: "E_avg(desk) = 312.4 lx, error <= 0.8 lx (0.26 %, estimated)".
std::string adaptation_text(const fem::Adaptation& adaptation, const scene::Scene& scene);
results::Record adaptation_record(const fem::Adaptation& adaptation, const scene::Scene& scene);

/// "E_avg(desk) = 312.4 lx, error <= 0.8 lx (0.26 %, estimated)", or with a proved error
/// "E_avg(desk) = 312.4 lx, error <= 3.1 lx (1 %, guaranteed; estimated 0.8)".  The error is rounded up, and holds of
/// the number as it is told.
std::string goal_line(const std::string& quantity, double value, double error, const char* unit,
                      std::optional<double> proved = {});

}  // namespace interflect::apps
