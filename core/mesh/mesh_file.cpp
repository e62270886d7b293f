#include "core/mesh/mesh_file.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/input/usage_error.h"

namespace ptb {
namespace {

Vec3 to_vec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

void add_mesh(const aiMesh& mesh, const aiMatrix4x4& placed, MeshFile& result) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) {
            ++result.points_and_lines;
            continue;
        }
        const auto corner = [&](unsigned k) { return to_vec3(placed * mesh.mVertices[face.mIndices[k]]); };
        result.geometry.add(corner(0), corner(1), corner(2));
    }
}

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, MeshFile& result) {
    const aiMatrix4x4 placed = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*scene.mMeshes[node.mMeshes[i]], placed, result);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], placed, result);
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& file) {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (scene == nullptr)
        throw UsageError(std::string("cannot read ") + file.string() + ": " + importer.GetErrorString());
    MeshFile result;
    add_node(*scene, *scene->mRootNode, aiMatrix4x4(), result);
    return result;
}

}  // namespace ptb
