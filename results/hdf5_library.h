#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

/// How the HDF5 library is called: in turns, with its complaints as our errors, and what it opens closed again.
namespace interflect::results::hdf5 {

using Id = std::int64_t;  ///< the library's hid_t

/// What the library remembers of its last failure.
struct Complaint {
  std::string of_system;   ///< "No space left on device"; empty where the system had no part in it
  std::string of_library;  ///< the innermost
};
/// Within a turn.
Complaint last_complaint();

/// One turn with the library, which has one state for the whole process and does not lock it; its own reports go
/// nowhere.
class Turn {
 public:
  Turn();
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  int (*report_)(Id, void*) = nullptr;
  void* reported_to_ = nullptr;
};

/// Something of the library's that has to be closed.
class Handle {
 public:
  Handle(Id id, int (*close)(Id)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator Id() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for what it holds
  Id release() { return std::exchange(id_, -1); }

 private:
  Id id_;
  int (*close_)(Id);
};

/// Within a turn: complains about what did not work.  What cannot be read, and not for the system's sake, is damaged:
/// which of its structures the library missed first says nothing to anybody.
class Checks {
 public:
  enum class Task : std::uint8_t { write, read };

  Checks(const std::filesystem::path& path, std::string trouble, Task task)
      : path_(path), trouble_(std::move(trouble)), task_(task) {}
  /// @throws core::InputError (DamagedFile)  where the library returned a number below 0
  template <class Result>
  Result operator()(Result result) const {
    if (result < 0) fail(last_complaint());
    return result;
  }

 private:
  [[noreturn]] void fail(const Complaint& said) const;

  const std::filesystem::path& path_;
  std::string trouble_;
  Task task_;
};

Checks writing(const std::filesystem::path& path);
Checks reading(const std::filesystem::path& path, const std::string& name);

}  // namespace interflect::results::hdf5
