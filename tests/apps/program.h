#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace interflect::test {

/// What a run of the program ended with.
struct Outcome {
  int status;  ///< exit status, or 128 + the signal that ended it
  std::string out, err;
};

/// What happens to the program while it runs.
struct Circumstances {
  long memory_limit_kb = 0;        ///< address space that it may have; 0: no limit
  double interrupt_after_s = 0;    ///< Ctrl-C comes then; 0: never
};

/// Runs `interflect ARGUMENTS`.
Outcome interflect(const std::vector<std::string>& arguments, const Circumstances& circumstances = {});

/// A folder that is gone at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& content) const;  ///< path of the file written
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);
std::string shipped_scene(const std::string& name);  ///< data/scenes/NAME.json

}  // namespace interflect::test
