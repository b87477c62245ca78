#include "results/hdf5_library.h"

#include <hdf5.h>

#include <algorithm>
#include <type_traits>

#include "core/error.h"
#include "results/hdf5_file.h"

namespace interflect::results::hdf5 {
namespace {

static_assert(std::is_same_v<hid_t, Id>);

std::mutex& library_mutex() {
  // All that is opened here is closed here.  Of damaged files the library loses track, and prints so when the program
  // ends.
  [[maybe_unused]] static const herr_t no_clearing_up = H5dont_atexit();
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Complaint last_complaint() {
  Complaint said;
  const auto look = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
    Complaint& found = *static_cast<Complaint*>(out);
    const std::string description = error->desc ? error->desc : "";
    const std::string key = "error message = '";
    if (const auto at = description.find(key); at != std::string::npos) {
      found.of_system = core::single_line(description.substr(at + key.size()));
      found.of_system.erase(std::min(found.of_system.find('\''), found.of_system.size()));
      return 1;  // that is all
    }
    if (found.of_library.empty()) found.of_library = core::single_line(description);
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &said);
  return said;
}

Turn::Turn() : lock_(library_mutex()) {
  H5Eget_auto2(H5E_DEFAULT, &report_, &reported_to_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
Turn::~Turn() { H5Eset_auto2(H5E_DEFAULT, report_, reported_to_); }

void Checks::fail(const Complaint& said) const {
  const std::string trouble = trouble_ + ": ";
  if (!said.of_system.empty()) throw core::InputError(path_.string(), trouble + said.of_system);
  if (task_ == Task::read) throw DamagedFile(path_.string(), trouble + "the file is damaged or cut short");
  throw core::InputError(path_.string(),
                         trouble + (said.of_library.empty() ? "the HDF5 library says no more" : said.of_library));
}

Checks writing(const std::filesystem::path& path) { return {path, "cannot be written", Checks::Task::write}; }
Checks reading(const std::filesystem::path& path, const std::string& name) {
  return {path, "'" + name + "' cannot be read", Checks::Task::read};
}

}  // namespace interflect::results::hdf5
