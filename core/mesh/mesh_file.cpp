#include "core/mesh/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/input/printable.h"
#include "core/input/usage_error.h"
#include "core/mesh/formats.h"

namespace ptb {

namespace mesh_formats {

void File::fail(const std::string& why) const {
    throw UsageError(fmt::format("cannot read {}: {}", printable(path.string()), why));
}

std::string File::part(std::uintmax_t offset, std::size_t most) const {
    std::ifstream stream(path, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(offset));
    std::string text(std::min<std::uintmax_t>(most, bytes - std::min(offset, bytes)), '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

}  // namespace mesh_formats

namespace {

namespace fs = std::filesystem;
using mesh_formats::File;

constexpr std::uintmax_t most_file_bytes = std::uintmax_t{4} << 30;
constexpr unsigned most_corners = 1024;  ///< of a polygon: cutting one takes the square of them in time

struct Format {
    std::string extension;
    void (*check)(const File&);           ///< none of glTF, which is written anew
    std::uint64_t memory_bytes_per_byte;  ///< at the peak; measured on 320,000 triangles
};

const std::vector<Format> formats = {{".obj", mesh_formats::check_text, 10},
                                     {".ply", mesh_formats::check_ply, 8},
                                     {".stl", mesh_formats::check_stl, 6},
                                     {".gltf", nullptr, 10},
                                     {".glb", nullptr, 10}};

std::string extension_of(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

const Format& format_of(const File& file) {
    std::vector<std::string> known;
    const std::string extension = extension_of(file.path);
    for (const Format& format : formats) {
        if (format.extension == extension) return format;
        known.push_back(format.extension);
    }
    file.fail(fmt::format("\"{}\" is no format of meshes; allowed: {}", printable(extension),
                          fmt::join(known, ", ")));
}

File open_file(const fs::path& path) {
    File file{path, 0};
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) file.fail(std::strerror(error ? error.value() : ENOENT));
    if (fs::is_directory(status)) file.fail("it is a folder");
    if (!fs::is_regular_file(status)) file.fail("it is no regular file");
    if (!std::ifstream(path)) file.fail(std::strerror(errno));
    file.bytes = fs::file_size(path);
    if (file.bytes > most_file_bytes)
        file.fail(fmt::format("it is larger than {} GiB", most_file_bytes >> 30));
    return file;
}

/// Shows assimp one file, and none that it names: materials and pictures are not wanted.
class OneFile : public Assimp::DefaultIOSystem {
  public:
    explicit OneFile(const fs::path& file) : file_(file.string()) {}
    bool Exists(const char* name) const override { return name == file_; }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        return name == file_ ? DefaultIOSystem::Open(name, mode) : nullptr;
    }

  private:
    std::string file_;
};

class Progress : public Assimp::ProgressHandler {
  public:
    explicit Progress(const std::function<void(double)>& on_progress) : on_progress_(on_progress) {}
    bool Update(float share) override {
        if (on_progress_ && share >= 0) on_progress_(std::min(1.0, static_cast<double>(share)));
        return true;
    }

  private:
    const std::function<void(double)>& on_progress_;
};

bool is_finite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_face(const File& file, const aiMesh& mesh, unsigned number) {
    const aiFace& face = mesh.mFaces[number];
    if (face.mNumIndices > most_corners)
        file.fail(fmt::format("face {} has {} corners; allowed: at most {}", number, face.mNumIndices,
                              most_corners));
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
        const unsigned vertex = face.mIndices[i];
        if (vertex >= mesh.mNumVertices)
            file.fail(
                fmt::format("face {} has vertex {}, and there are {}", number, vertex, mesh.mNumVertices));
        if (!is_finite(mesh.mVertices[vertex]))
            file.fail(fmt::format("face {} has a vertex that is not finite", number));
    }
}

/// Takes what assimp read out of its tree of nodes.
class Taken {
  public:
    Taken(const File& file, const aiScene& scene, std::uint64_t most_triangles) : file_(file), scene_(scene) {
        for (unsigned i = 0; i < scene.mNumMeshes; ++i)
            for (unsigned k = 0; k < scene.mMeshes[i]->mNumFaces; ++k) check_face(file, *scene.mMeshes[i], k);
        const std::uint64_t triangles = count(*scene.mRootNode);
        if (triangles == 0) file.fail("it has no faces");
        if (triangles > most_triangles)
            file.fail(fmt::format("it has {} triangles; allowed: {}", triangles, most_triangles));
    }

    MeshFile read() {
        add(*scene_.mRootNode, aiMatrix4x4());
        return std::move(result_);
    }

  private:
    std::uint64_t count(const aiNode& node) const {
        std::uint64_t triangles = 0;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
            for (unsigned k = 0; k < mesh.mNumFaces; ++k)
                triangles += std::max(mesh.mFaces[k].mNumIndices, 2U) - 2;
        }
        for (unsigned i = 0; i < node.mNumChildren; ++i) triangles += count(*node.mChildren[i]);
        return triangles;
    }

    void add(const aiNode& node, const aiMatrix4x4& parent) {
        const aiMatrix4x4 placed = parent * node.mTransformation;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*scene_.mMeshes[node.mMeshes[i]], placed);
        for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], placed);
    }

    void add_mesh(const aiMesh& mesh, const aiMatrix4x4& placed) {
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices == 3)
                add_face(mesh, face, placed);
            else
                ++result_.points_and_lines;
        }
    }

    void add_face(const aiMesh& mesh, const aiFace& face, const aiMatrix4x4& placed) {
        Vec3 corners[3];
        for (unsigned k = 0; k < 3; ++k) {
            const aiVector3D v = placed * mesh.mVertices[face.mIndices[k]];
            if (!is_finite(v)) file_.fail("a node of it takes a vertex to where it is not finite");
            corners[k] = {v.x, v.y, v.z};
        }
        result_.geometry.add(corners[0], corners[1], corners[2]);
    }

    const File& file_;
    const aiScene& scene_;
    MeshFile result_;
};

/// assimp's words on one line, without the file's name.
std::string words_of(const Assimp::Importer& importer) {
    const std::string words = importer.GetErrorString();
    return words.empty() ? "it is damaged" : shortened(printable(words), 200);
}

/// The importer keeps what it read.
const aiScene* import(Assimp::Importer& importer, const File& file, const Format& format) {
    if (format.check == nullptr) {
        const std::string glb = mesh_formats::bare_glb(file);
        return importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
    }
    format.check(file);
    importer.SetIOHandler(std::make_unique<OneFile>(file.path).release());  // the importer owns it
    return importer.ReadFile(file.path.string(), 0);
}

}  // namespace

std::vector<fs::path> files_of_mesh(const fs::path& path) {
    std::vector<fs::path> files = {path};
    if (extension_of(path) != ".gltf" && extension_of(path) != ".glb") return files;
    const std::vector<fs::path> buffers = mesh_formats::buffer_files(open_file(path));
    files.insert(files.end(), buffers.begin(), buffers.end());
    return files;
}

std::uint64_t mesh_file_memory(const fs::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(path, error);
    for (const Format& format : formats)
        if (!error && format.extension == extension_of(path)) return bytes * format.memory_bytes_per_byte;
    return 0;
}

MeshFile read_mesh_file(const fs::path& path, const MeshFileOptions& options) {
    const File file = open_file(path);
    Assimp::Importer importer;
    importer.SetProgressHandler(std::make_unique<Progress>(options.on_progress).release());  // as well
    const aiScene* const scene = import(importer, file, format_of(file));
    if (scene == nullptr || scene->mRootNode == nullptr) file.fail(words_of(importer));
    Taken taken(file, *scene, options.most_triangles);
    if (importer.ApplyPostProcessing(aiProcess_Triangulate) == nullptr) file.fail(words_of(importer));
    return taken.read();
}

}  // namespace ptb
