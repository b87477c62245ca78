#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/record.h"
#include "validation/certificate.h"

namespace interflect::results {

/// The contents of validation.json (docs/results.md): verdict, norms, what disagrees by name, energy, and every
/// measurement.
/// @param judged    what the certificate was made from, in the same order
/// @param channels  their names
Record certificate_record(const validation::Certificate& certificate, std::span<const validation::Judged> judged,
                          const std::vector<std::string>& channels);

}  // namespace interflect::results
