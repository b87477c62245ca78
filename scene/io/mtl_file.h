#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace interflect::scene::io {

/// A material of a Wavefront MTL file as it stands there.  What is understood of it: mtl_material.h.
struct MtlEntry {
  struct Statement {
    std::string key;
    std::vector<std::string> words;
    std::string place;  ///< "room.mtl:12"
  };
  std::string name, place;
  std::vector<Statement> statements;

  /// The last of this key, which counts; null where there is none.
  const Statement* find(const std::string& key) const;
};

/// Its materials, of every name the first.
/// @param shown  how messages name the file
/// @throws core::InputError  no such file, no text, a statement before the first "newmtl"
std::vector<MtlEntry> read_mtl(const std::filesystem::path& file, const std::string& shown);

/// The files that an OBJ's "mtllib" names: all of the line where that is a file, since names have blanks, or each word.
std::vector<std::filesystem::path> mtl_files(const std::filesystem::path& folder, const std::string& named);

}  // namespace interflect::scene::io
