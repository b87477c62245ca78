// PLY, STL and glTF through assimp, which keeps coordinates as floats.
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/assimp_guard.h"
#include "scene/io/mesh_reader.h"

namespace interflect::scene::io {
namespace {

/// The files of the disk, but the guarded bytes in place of the mesh file's own.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  GuardedFiles(const std::filesystem::path& file, const std::string& bytes) : file_(file.string()), bytes_(bytes) {}

  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (name != file_) return Assimp::DefaultIOSystem::Open(name, mode);
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }

 private:
  std::string file_;
  const std::string& bytes_;
};

class SceneWalk {
 public:
  SceneWalk(const aiScene& scene, const std::string& shown) : scene_(scene), shown_(shown) {}

  MeshFile run() {
    mesh_.single_precision = true;
    if (scene_.mRootNode) node(*scene_.mRootNode, Eigen::Matrix4d::Identity());
    if (ignored_ > 0) mesh_.notes.push_back(core::format("%zu points and lines ignored", ignored_));
    mesh_.groups = groups_.names();
    mesh_.materials = materials_.names();
    return std::move(mesh_);
  }

 private:
  /// Meshes as the node places them: the tree is shallow, which `read_guarded` has seen to.
  void node(const aiNode& n, const Eigen::Matrix4d& parent) {
    const aiMatrix4x4& m = n.mTransformation;
    Eigen::Matrix4d own;
    own << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
    const Eigen::Matrix4d placed = parent * own;
    for (unsigned k = 0; k < n.mNumMeshes; ++k) {
      if (n.mMeshes[k] >= scene_.mNumMeshes)
        throw core::InputError(shown_, "a node refers to a mesh that does not exist");
      add(*scene_.mMeshes[n.mMeshes[k]], n, placed);
    }
    for (unsigned k = 0; k < n.mNumChildren; ++k) node(*n.mChildren[k], placed);
  }

  void add(const aiMesh& mesh, const aiNode& n, const Eigen::Matrix4d& placed) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      const aiVector3D& v = mesh.mVertices[k];
      const Vec3 x(v.x, v.y, v.z);
      mesh_.vertices.emplace_back(placed.topLeftCorner<3, 3>() * x + placed.topRightCorner<3, 1>());
    }
    const std::string group = mesh.mName.length > 0 ? mesh.mName.C_Str() : n.mName.C_Str();
    const std::uint32_t group_index = groups_.index_of(group);
    const std::uint32_t material = materials_.index_of(material_name(mesh.mMaterialIndex));
    const bool mirrored = placed.topLeftCorner<3, 3>().determinant() < 0;  // turns every face over: turn it back
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++ignored_;
        continue;
      }
      mesh_.faces.push_back(
          {static_cast<std::uint32_t>(mesh_.indices.size()), face.mNumIndices, group_index, material});
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
        if (index >= mesh.mNumVertices)
          throw core::InputError(shown_, core::format("a face refers to vertex %u of %u", index, mesh.mNumVertices));
        mesh_.indices.push_back(first + index);
      }
    }
  }

  /// "" for the material that assimp makes up where a file has none.
  std::string material_name(unsigned index) const {
    if (index >= scene_.mNumMaterials) return "";
    aiString name;
    if (scene_.mMaterials[index]->Get(AI_MATKEY_NAME, name) != aiReturn_SUCCESS) return "";
    const std::string text = name.C_Str();
    return text == AI_DEFAULT_MATERIAL_NAME ? "" : text;
  }

  const aiScene& scene_;
  const std::string& shown_;
  MeshFile mesh_;
  NameList groups_, materials_;
  std::size_t ignored_ = 0;
};

}  // namespace

MeshFile read_by_assimp(const std::filesystem::path& file, const std::string& shown) {
  const GuardedFile guarded = read_guarded(file, shown);
  Assimp::Importer importer;  // no post-processing: vertices stay unjoined, polygons whole
  importer.SetIOHandler(new GuardedFiles(file, guarded.bytes));  // the importer owns it
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (!scene) throw core::InputError(shown, core::single_line(importer.GetErrorString()));
  MeshFile mesh = SceneWalk(*scene, shown).run();
  std::size_t read = 0;
  for (unsigned k = 0; k < scene->mNumMeshes; ++k) read += scene->mMeshes[k]->mNumFaces;
  if (guarded.faces && read < *guarded.faces)
    mesh.notes.push_back(core::format("%zu faulty face(s) left out by the reader", *guarded.faces - read));
  return mesh;
}

}  // namespace interflect::scene::io
