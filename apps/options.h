#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fem/radiosity.h"

/// What the command line says, as plain values: the commands see no parser.
namespace interflect::apps {

struct CommonOptions {
  std::uint64_t seed = 1;
  unsigned threads = 0;  ///< 0: all
  bool quiet = false;
  bool verbose = false;
  bool json = false;  ///< results on standard output as one JSON object
  std::string command_line;
};

struct SolveOptions {
  std::filesystem::path scene, out;
  fem::RadiositySettings settings;
  bool forecast_only = false;
  bool pictures = true;
};

struct ValidateOptions {
  SolveOptions solve;
  double accuracy = 0.01;      ///< relative standard error asked of each traced value
  bool all_elements = false;
  int elements = 500;          ///< judged, when not all
  int picture_samples = 64;    ///< per pixel of the traced picture
};

struct TraceOptions {
  std::filesystem::path scene, image;
  std::string camera;  ///< empty: the scene's first
  int samples = 64;
  std::filesystem::path estimates;  ///< folder for surfaces.csv and sensors.csv; empty: none
  double accuracy = 0.01;
  std::string intersector = "embree";
};

struct InfoOptions {
  std::filesystem::path scene;
};

struct CheckOptions {
  std::filesystem::path scene;
};

}  // namespace interflect::apps
