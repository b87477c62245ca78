#include "fem/form_factor/hemicube.h"

#include "fem/form_factor/max_cells.h"

namespace interflect::fem {

Hemicube::Hemicube(const FormFactorContext& context, std::string name, HemicubeGrid grid)
    : RowMethod(context), name_(std::move(name)), grid_(std::move(grid)) {}

std::unique_ptr<Sight> Hemicube::sight() const { return std::make_unique<HemicubeSight>(grid_); }

ExactHemicube::ExactHemicube(const FormFactorContext& context)
    : Hemicube(context, "hemicube", HemicubeGrid::uniform(even_resolution(context.resolution))) {}

MidpointHemicube::MidpointHemicube(const FormFactorContext& context)
    : Hemicube(context, "hemicube-midpoint",
               HemicubeGrid::uniform(even_resolution(context.resolution), CellWeights::midpoint)) {}

MaxHemicube::MaxHemicube(const FormFactorContext& context)
    : Hemicube(context, "hemicube-max", max_cells(even_resolution(context.resolution))) {}

}  // namespace interflect::fem
