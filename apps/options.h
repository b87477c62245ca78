#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "fem/radiosity.h"
#include "scene/geometry_file.h"

/// What the command line says, as plain values: the commands see no parser.
namespace interflect::apps {

struct CommonOptions {
  std::uint64_t seed = 1;
  unsigned threads = 0;  ///< 0: all
  bool quiet = false;
  bool verbose = false;
  double max_time = 0;  ///< [s] after which it stops as by Ctrl-C; 0: none
  bool json = false;    ///< results on standard output as one JSON object
  std::string command_line;
};

struct SolveOptions {
  std::filesystem::path scene, out;
  fem::RadiositySettings settings;
  std::string goal;               ///< what elements are made for, where there is a target or a name (goals.h)
  double target_error = 0;        ///< of the goal over its value; 0: elements are not made for it
  std::filesystem::path factors;  ///< an .h5 of view factors to use; empty: they are computed
  bool forecast_only = false;
  bool pictures = true;
  bool bounds = false;    ///< proved ones are found too
  bool residual = false;  ///< its norms are found too
};

struct DimOptions {
  std::filesystem::path solution, out;  ///< the folder of a solve; empty out: `dimmed` in it
  std::vector<std::string> groups;      ///< NAME=PART
  bool pictures = true;
};

struct ValidateOptions {
  SolveOptions solve;
  double accuracy = 0.01;           ///< relative standard error asked of each traced value
  std::string integrator = "path";  ///< by which they are traced
  bool all_elements = false;
  int elements = 500;        ///< judged, when not all
  int picture_samples = 64;  ///< per pixel of the traced picture
};

/// Rays a pixel where none are asked for: usually, and beside mirrors and glass, without and with a gather at each.
inline constexpr int rays_a_pixel = 4, rays_by_mirrors = 64, rays_by_mirrors_gathered = 16;

struct RenderOptions {
  SolveOptions solve;
  std::filesystem::path image;
  std::string camera;  ///< empty: the scene's first
  bool gather = false;
  int rays = 0;  ///< a pixel; 0: as many as the scene asks for (render.cpp)
};

struct TraceOptions {
  std::filesystem::path scene, image;
  std::string camera;  ///< empty: the scene's first
  int samples = 64;
  std::string filter = "box", sequence = "independent";
  bool resume = false;              ///< from the checkpoint of an earlier run
  bool keep_checkpoint = false;     ///< of a picture that has all that was asked for too
  std::filesystem::path estimates;  ///< folder for surfaces.csv and sensors.csv; empty: none
  std::string integrator = "path";
  std::string paths = "L.*E";  ///< that count
  std::string group;           ///< of lights that shine alone; empty: all do
  double target = 0;           ///< of the picture; 0: none
  double accuracy = 0.01;
  std::string intersector = "embree";
};

struct CompareOptions {
  std::filesystem::path scene, out;
  std::vector<std::string> integrators;  ///< empty: all
  double target = 0.01;                  ///< relative standard error of each measurement
  std::string paths = "L.*E";            ///< that count
  std::string camera;                    ///< empty: the scene's first
  int samples = 16;                      ///< a pixel of the pictures
  int replications = 32;                 ///< by which mean z are judged; 0: they are told alone
  bool pictures = true;
  std::string intersector = "embree";
};

struct InfoOptions {
  std::filesystem::path scene;
};

struct ViewFactorOptions {
  std::filesystem::path input, out;
  scene::GeometryOptions geometry;
  std::string form_factors = "analytic";
  double tolerance = 1e-4;  ///< on the largest row's sum of errors
  double element_size = 0;  ///< longest edge [m]; 0: one element a face
  int visibility_rays = 16, resolution = 256;
  double visibility_error = 0;  ///< of a pair's visible part, one sigma; 0: as the rays have it
  std::uint64_t samples = 0;
  std::string closure = "none";
  std::string groups;   ///< what the factors of a .csv are summed by; empty: by nothing
  std::string view_of;  ///< a surface whose share of every element's view is drawn; empty: none
  bool forecast_only = false;
};

struct CompareFormFactorsOptions {
  std::filesystem::path scene, out;
  double element_size = 0;  ///< 0: as a solve has it
  double tolerance = 1e-4;  ///< of the reference's rows
};

struct SolversOptions {};

struct CompareSolversOptions {
  std::filesystem::path scene, out;
  fem::RadiositySettings settings;
  std::vector<std::string> solvers;  ///< empty: all
  std::string goal;                  ///< the one number asked for (goals.h); empty: all of the solution
};

struct ShootOptions {
  std::filesystem::path scene, out;
  fem::RadiositySettings settings;
  int every = 0;                                ///< shots, after which there is a look; 0: at the end alone
  int shots = std::numeric_limits<int>::max();  ///< in all, after which it stops
  bool resume = false;                          ///< from the checkpoint of an earlier run
  bool pictures = true;
};

struct ExchangeOptions {
  std::filesystem::path scene, out;
  fem::RadiositySettings settings;
  double environment = 0;  ///< [K]
  bool pictures = true;
};

struct CheckOptions {
  std::filesystem::path scene;
};

}  // namespace interflect::apps
