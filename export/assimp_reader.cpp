// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/assimp_reader.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <locale>
#include <string>
#include <utility>

#include "trueflank/base/system_failure.h"
#include "trueflank/export/mesh_parsers.h"

namespace trueflank::io {
namespace {

constexpr int kMostSeconds = 120;
constexpr std::size_t kBytesOfAnyFile = std::size_t{512} << 20, kBytesPerByte = 100, kMostBytes = std::size_t{4} << 30;

/// Address space for reading so many bytes, beside what this process has already.
rlim_t memory_bound(std::size_t file_bytes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return static_cast<void>(file_bytes), RLIM_INFINITY;  // their shadow memory alone is larger
#else
  std::array<char, 64> text{};
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  const ssize_t length = file < 0 ? 0 : read(file, text.data(), text.size() - 1);
  if (file >= 0) close(file);
  std::size_t pages = 0;
  std::from_chars(text.data(), text.data() + std::max<ssize_t>(length, 0), pages);
  const std::size_t held = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return held + std::min(kBytesOfAnyFile + kBytesPerByte * file_bytes, kMostBytes);
#endif
}

/// How what assimp returns becomes millimetres with z up.
struct Convention {
  std::string_view extension;
  double to_mm = 1.0;
  bool y_up = false;
  enum class Stated { kNothing, kAmfUnit, kFbxUnit } stated = Stated::kNothing;
};

// assimp turns Collada (by its unit and up axis) and 3DS into its own frame, metres and y up; of AMF and FBX it gives
// the numbers as they stand.
constexpr std::array<Convention, 7> kConventions{{{".off"},
                                                  {".amf", 1.0, false, Convention::Stated::kAmfUnit},
                                                  {".dae", 1000.0, true},
                                                  {".fbx", 10.0, true, Convention::Stated::kFbxUnit},
                                                  {".3ds", 1.0, true},
                                                  {".gltf", 1000.0, true},
                                                  {".x3d", 1000.0, true}}};

const Convention* convention_of(std::string_view extension) {
  for (const Convention& c : kConventions)
    if (c.extension == extension) return &c;
  return nullptr;
}

/// `unit` of an AMF file's first element in mm; what the format takes where there is none.
double amf_unit_mm(std::string_view content) {
  const std::size_t element = content.find("<amf");
  if (element == std::string_view::npos) return 1.0;
  const std::string_view head = content.substr(element, std::min(content.find('>', element), content.size()) - element);
  for (const auto& [name, mm] : {std::pair<std::string_view, double>{"inch", 25.4},
                                 {"feet", 304.8},
                                 {"meter", 1000.0},
                                 {"micron", 0.001}})
    for (const char quote : {'"', '\''})
      if (head.find("unit=" + (quote + std::string(name)) + quote) != std::string_view::npos) return mm;
  return 1.0;
}

// What the reading process says: a byte that tells what follows, a count, and so many bytes, or facets of nine doubles.
enum Tag : char { kBody = 'b', kFacets = 'f', kEnd = 'e', kWrong = 'w' };
constexpr std::size_t kFacetsAtOnce = 4096;
constexpr std::uint32_t kLongestText = 1000;

/// The library's functions that are needed, by their names; all null where it cannot be loaded.
struct Assimp {
  decltype(&aiImportFileFromMemory) import = nullptr;
  decltype(&aiGetErrorString) error = nullptr;
  Assimp() {
    void* const library = dlopen(TRUEFLANK_ASSIMP_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!library) return;
    import = reinterpret_cast<decltype(import)>(dlsym(library, "aiImportFileFromMemory"));
    error = reinterpret_cast<decltype(error)>(dlsym(library, "aiGetErrorString"));
  }
};

/// The process that reads: says on a pipe what it finds, and ends.
class Teller {
 public:
  Teller(int pipe, std::string_view content, const Convention& convention)
      : pipe_(pipe), content_(content), convention_(convention) {}

  void run() {
    const Assimp assimp;
    if (!assimp.import || !assimp.error) return say(kWrong, "");
    const aiScene* const scene =
        assimp.import(content_.data(), static_cast<unsigned>(content_.size()), aiProcess_Triangulate,
                      std::string(convention_.extension.substr(1)).c_str());
    if (!scene || !scene->mRootNode) {
      const char* const what = assimp.error();
      return say(kWrong, what && *what ? what : "nothing in it can be read");
    }
    find_frame(*scene);
    tell(*scene, *scene->mRootNode, {{{{1, 0, 0, 0}}, {{0, 1, 0, 0}}, {{0, 0, 1, 0}}}}, 0);
    say(kEnd, "");
  }

 private:
  using Matrix = std::array<std::array<double, 4>, 3>;

  void find_frame(const aiScene& scene) {
    scale_ = convention_.to_mm;
    y_up_ = convention_.y_up;
    if (convention_.stated == Convention::Stated::kAmfUnit) scale_ = amf_unit_mm(content_);
    if (convention_.stated != Convention::Stated::kFbxUnit || !scene.mMetaData) return;
    for (unsigned i = 0; i < scene.mMetaData->mNumProperties; ++i) {
      const std::string_view key = scene.mMetaData->mKeys[i].C_Str();
      const aiMetadataEntry& value = scene.mMetaData->mValues[i];
      if (key == "UpAxis" && value.mType == AI_INT32) y_up_ = *static_cast<const std::int32_t*>(value.mData) == 1;
      if (key != "UnitScaleFactor") continue;
      double cm = 0.0;
      if (value.mType == AI_FLOAT) cm = *static_cast<const float*>(value.mData);
      if (value.mType == AI_DOUBLE) cm = *static_cast<const double*>(value.mData);
      if (cm > 0.0) scale_ = 10.0 * cm;
    }
  }

  void tell(const aiScene& scene, const aiNode& node, const Matrix& above, int depth) {
    if (depth > 200) return;  // the reader refuses far fewer
    const aiMatrix4x4& own = node.mTransformation;
    Matrix here{};
    for (unsigned r = 0; r < 3; ++r)
      for (unsigned c = 0; c < 4; ++c) {
        here[r][c] = c == 3 ? above[r][3] : 0.0;
        for (unsigned k = 0; k < 3; ++k) here[r][c] += above[r][k] * static_cast<double>(own[k][c]);
      }
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (const unsigned mesh = node.mMeshes[i]; mesh < scene.mNumMeshes) tell(*scene.mMeshes[mesh], node, here);
    for (unsigned i = 0; i < node.mNumChildren; ++i) tell(scene, *node.mChildren[i], here, depth + 1);
  }

  void tell(const aiMesh& mesh, const aiNode& node, const Matrix& here) {
    const std::string_view own = mesh.mName.C_Str(), of_node = node.mName.C_Str();
    say(kBody, (own.empty() ? of_node : own).substr(0, kLongestText));
    facets_.clear();
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      if (*std::max_element(face.mIndices, face.mIndices + 3) >= mesh.mNumVertices) continue;
      for (unsigned corner = 0; corner < 3; ++corner) tell(mesh.mVertices[face.mIndices[corner]], here);
      if (facets_.size() == 9 * kFacetsAtOnce) flush();
    }
    flush();
  }

  void tell(const aiVector3D& vertex, const Matrix& here) {
    const double p[3] = {vertex.x, vertex.y, vertex.z};
    std::array<double, 3> at{};
    for (std::size_t r = 0; r < 3; ++r)
      at[r] = scale_ * (here[r][0] * p[0] + here[r][1] * p[1] + here[r][2] * p[2] + here[r][3]);
    if (y_up_) at = {at[0], -at[2], at[1]};
    facets_.insert(facets_.end(), at.begin(), at.end());
  }

  void flush() {
    if (facets_.empty()) return;
    head(kFacets, static_cast<std::uint32_t>(facets_.size() / 9));
    put(facets_.data(), facets_.size() * sizeof(double));
    facets_.clear();
  }
  void say(Tag tag, std::string_view text) {
    text = text.substr(0, kLongestText);
    head(tag, static_cast<std::uint32_t>(text.size()));
    put(text.data(), text.size());
  }
  void head(Tag tag, std::uint32_t count) {
    put(&tag, 1);
    put(&count, sizeof count);
  }
  void put(const void* data, std::size_t bytes) {
    for (const char* at = static_cast<const char*>(data); bytes > 0;) {
      const ssize_t done = write(pipe_, at, bytes);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) _exit(1);
      at += done;
      bytes -= static_cast<std::size_t>(done);
    }
  }

  int pipe_;
  std::string_view content_;
  Convention convention_;
  double scale_ = 1.0;
  bool y_up_ = false;
  std::vector<double> facets_;
};

[[noreturn]] void read_and_tell(int pipe, std::string_view content, const Convention& convention) {
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ, SIGXCPU}) std::signal(signal, SIG_DFL);
  const auto bound = [](auto what, rlim_t most) {
    const rlimit limit{most, most};
    static_cast<void>(setrlimit(what, &limit));
  };
  bound(RLIMIT_CORE, 0);
  bound(RLIMIT_AS, memory_bound(content.size()));
  bound(RLIMIT_CPU, kMostSeconds);
  if (const int null = open("/dev/null", O_RDWR | O_CLOEXEC); null >= 0) {
    for (const int standard : {0, 1, 2})
      if (standard != pipe) static_cast<void>(dup2(null, standard));
    if (null > 2) close(null);  // the library is a file to open, where few may be open
  }
  try {
    std::locale::global(
        std::locale::classic());  // assimp reads 15.5 as 15 where a comma is the decimal point
    Teller(pipe, content, convention).run();
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

/// The process that asked: takes what the other says, within the file's budget.
class Listener {
 public:
  Listener(int pipe, Reading& reading) : pipe_(pipe), reading_(reading) {}

  Result<Bodies> run() {
    for (;;) {
      char tag = 0;
      std::uint32_t count = 0;
      if (!take(&tag, 1) || !take(&count, sizeof count)) return broken();
      if (tag == kEnd) return finished();
      if (tag == kFacets) {
        if (auto status = take_facets(count); !status) return fail(std::move(status.error()));
        continue;
      }
      std::string text(std::min(count, kLongestText), '\0');
      if (!take(text.data(), text.size())) return broken();
      if (tag == kWrong) return refused(text);
      if (auto status = reading_.take_piece(); !status) return fail(std::move(status.error()));
      close_body();
      bodies_.push_back({std::move(text), {}});
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  Status take_facets(std::uint32_t count) {
    if (count > kFacetsAtOnce || bodies_.empty()) return fail(broken().error());
    if (auto status = reading_.take_facets(count, 0); !status) return status;
    facets_.resize(count);
    if (!take(facets_.data(), count * sizeof(Facet))) return fail(broken().error());
    for (const Facet& facet : facets_) welder_.add_triangle(facet);
    return {};
  }
  void close_body() {
    if (!bodies_.empty()) bodies_.back().mesh = std::exchange(welder_, Welder(kFacetsAtOnce)).take();
  }
  Result<Bodies> finished() {
    close_body();
    std::erase_if(bodies_, [](const MeshBody& body) { return body.mesh.triangles.empty(); });
    if (bodies_.empty()) return syntax_error("the mesh has no triangle");
    return std::move(bodies_);
  }
  static Result<Bodies> refused(const std::string& text) {
    if (!text.empty()) return syntax_error("assimp cannot read it: " + text);
    return fail(Error{.code = ErrorCode::kUnsupported,
                      .message = "this format is read by assimp, which is not installed (" TRUEFLANK_ASSIMP_LIBRARY ")",
                      .remedy = "apt-get install libassimp5, or a file in STL, OBJ, PLY, 3MF or GLB"});
  }
  /// It died, or took too long.
  [[nodiscard]] Result<Bodies> broken() const {
    return fail(Error{.code = late_ ? ErrorCode::kUnsupported : ErrorCode::kSyntax,
                      .message = late_ ? "assimp did not read it within " + std::to_string(kMostSeconds) + " s"
                                       : "assimp broke off while reading it: damaged, or it expands beyond bounds",
                      .remedy = "a file in STL, OBJ, PLY, 3MF or GLB"});
  }
  bool take(void* data, std::size_t bytes) {
    for (char* at = static_cast<char*>(data); bytes > 0;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
      pollfd waiting{pipe_, POLLIN, 0};
      const int ready = left > 0 ? poll(&waiting, 1, static_cast<int>(left)) : 0;
      if (ready < 0 && errno == EINTR) continue;
      if (ready == 0) late_ = true;
      if (ready <= 0) return false;
      const ssize_t done = read(pipe_, at, bytes);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return false;
      at += done;
      bytes -= static_cast<std::size_t>(done);
    }
    return true;
  }

  int pipe_;
  Reading& reading_;
  Clock::time_point end_ = Clock::now() + std::chrono::seconds(kMostSeconds);
  bool late_ = false;
  Bodies bodies_;
  Welder welder_{kFacetsAtOnce};
  std::vector<Facet> facets_;
};

/// The process that reads, and the end of the pipe it writes to; both end with this object.
struct Child {
  pid_t id = -1;
  int pipe = -1;
  Child(pid_t process, int end) : id(process), pipe(end) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    close(pipe);
    static_cast<void>(kill(id, SIGKILL));  // it has said all, or nothing more is wanted
    while (waitpid(id, nullptr, 0) < 0 && errno == EINTR) {}
  }
};

}  // namespace

std::string assimp_extensions(std::string_view separator) {
  std::string all;
  for (const Convention& c : kConventions) all += (all.empty() ? "" : std::string(separator)) + std::string(c.extension);
  return all;
}

bool is_assimp_extension(std::string_view extension) { return convention_of(extension) != nullptr; }

namespace {

Error not_begun(std::string_view what, int error_number) {
  SystemFailure why = system_failure(error_number, SystemUse::kStartProcess);
  return {.code = ErrorCode::kDisk,
          .message = std::string(what) + why.reason,
          .value = std::move(why.limit),
          .remedy = std::move(why.remedy)};
}

}  // namespace

Result<Bodies> parse_by_assimp(std::string_view content, std::string_view extension, Reading& reading) {
  const Convention* const convention = convention_of(extension);
  if (!convention) return syntax_error("no format that assimp is asked for");
  if (content.size() >= kMostBytes)  // its sizes have 32 bits
    return fail(Error{.code = ErrorCode::kUnsupported, .message = "assimp reads no file of 4 GB or more"});
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    return fail(not_begun("no pipe to read this format through: ", errno));
  const pid_t child = fork();
  if (child < 0) {
    const int number = errno;
    close(ends[0]);
    close(ends[1]);
    return fail(not_begun("no process to read this format in: ", number));
  }
  if (child == 0) {
    close(ends[0]);
    read_and_tell(ends[1], content, *convention);
  }
  close(ends[1]);
  const Child reader(child, ends[0]);
  return Listener(reader.pipe, reading).run();
}

}  // namespace trueflank::io
