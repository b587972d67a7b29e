// SPDX-License-Identifier: Apache-2.0
// video FILE [vulkan|gles] [OUT.png] [FRAMES]: plays a video on a screen in a room, and keeps the last of its frames.
#include <filament_core/filament_core.h>
#include <materials/screen.h>

#include <glm/ext/matrix_transform.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "video: error: %s\n", error.message.c_str());
    return 1;
}

constexpr size_t kLongestLine = 1000;
constexpr uint32_t kLargestSide = 16384;
const std::string kConvert = "; convert the video: ffmpeg -i IN -pix_fmt yuv420p OUT.y4m";

/// VideoFile: the frames of a video one after the other, with 4:2:0 chroma and 8 bits.
///   In      YUV4MPEG2 files (.y4m); any other video is decoded by the command ffmpeg, where it is installed. It gets
///           the name as a word of its own, without a shell.
///   Fails   one line: the file, the place in it, and what to do.
class VideoFile {
public:
    explicit VideoFile(std::string path) : mPath(std::move(path)) {}
    VideoFile(VideoFile const&) = delete;
    VideoFile& operator=(VideoFile const&) = delete;
    ~VideoFile();

    Result<void> open();
    /// Reads the next frame. False: there is none.
    Result<bool> next();

    /// Of plane 0 (luma), 1 or 2 (the differences to blue and red, half as wide and high).
    uint2 size(size_t plane) const { return plane == 0 ? mSize : (mSize + 1u) / 2u; }
    /// One byte a pixel, row 0 at the top.
    std::span<const std::byte> pixels(size_t plane) const;
    /// Codes 0 to 255 are black to white; else 16 to 235, and 16 to 240 for chroma.
    bool isFullRange() const { return mIsFullRange; }

private:
    Result<void> decode();
    Result<void> readHeader();
    Result<void> readProperty(std::string const& word);
    std::string readLine();
    Error error(std::string const& place, std::string const& message) const;

    std::string mPath;
    std::FILE* mStream = nullptr;
    pid_t mDecoder = 0; ///< 0: the file itself is read
    uint2 mSize{ 0 };
    bool mIsFullRange = false;
    std::vector<std::byte> mFrame; ///< its planes
    size_t mFrames = 0;            ///< that were read
};

VideoFile::~VideoFile() {
    if (mStream) std::fclose(mStream);
    if (mDecoder == 0) return;
    kill(mDecoder, SIGKILL); // if frames are left
    waitpid(mDecoder, nullptr, 0);
}

Error VideoFile::error(std::string const& place, std::string const& message) const {
    return { ErrorCode::Unreadable, "'" + mPath + "'" + (place.empty() ? "" : ", " + place) + ": " + message };
}

Result<void> VideoFile::open() {
    std::error_code none;
    if (!std::filesystem::exists(mPath, none)) return error("", "there is no such file");
    if (!std::filesystem::is_regular_file(mPath, none)) return error("", "is not a file");
    if (std::filesystem::path(mPath).extension() != ".y4m") {
        if (Result<void> done = decode(); !done) return done;
    } else {
        mStream = std::fopen(mPath.c_str(), "rbe");
        if (!mStream) return error("", std::strerror(errno));
    }
    return readHeader();
}

// Prints its errors to the standard error of this program.
Result<void> VideoFile::decode() {
    const std::string input = "file:" + std::filesystem::absolute(mPath).string();
    const std::array<const char*, 15> words{ "ffmpeg",
                                             "-nostdin",
                                             "-v",
                                             "error",
                                             "-i",
                                             input.c_str(),
                                             "-an",
                                             "-pix_fmt",
                                             "yuv420p",
                                             "-vf",
                                             "scale=out_color_matrix=bt601:out_range=tv",
                                             "-f",
                                             "yuv4mpegpipe",
                                             "-",
                                             nullptr };
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return error("", std::string("no pipe: ") + std::strerror(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    pid_t decoder = 0;
    const int failure = posix_spawnp(&decoder, words[0], &actions, nullptr, const_cast<char**>(words.data()), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    mStream = fdopen(ends[0], "rb");
    if (failure == 0) mDecoder = decoder;
    if (failure == ENOENT)
        return error("", "needs the command ffmpeg, which is not in PATH: install it (apt-get install ffmpeg), or give "
                         "a .y4m file");
    return failure == 0 ? Result<void>() : error("", std::string("ffmpeg does not start: ") + std::strerror(failure));
}

std::string VideoFile::readLine() {
    std::string line;
    for (int c = std::fgetc(mStream); c != EOF && c != '\n' && line.size() < kLongestLine; c = std::fgetc(mStream))
        line += static_cast<char>(c);
    return line;
}

Result<void> VideoFile::readHeader() {
    std::istringstream header(readLine());
    std::string word;
    header >> word;
    if (word != "YUV4MPEG2") {
        if (mDecoder != 0) return error("", "ffmpeg found no video in it");
        return error("line 1", "does not begin with YUV4MPEG2, so it is not a .y4m file" + kConvert);
    }
    while (header >> word) {
        if (Result<void> done = readProperty(word); !done) return done;
    }
    if (mSize.x == 0 || mSize.y == 0) return error("line 1", "lacks the width (W) or the height (H)" + kConvert);
    const uint2 chroma = size(1);
    mFrame.resize(size_t{ mSize.x } * mSize.y + 2 * size_t{ chroma.x } * chroma.y);
    return {};
}

Result<void> VideoFile::readProperty(std::string const& word) {
    const std::string value = word.substr(1);
    if (word[0] == 'W' || word[0] == 'H') {
        uint32_t& side = word[0] == 'W' ? mSize.x : mSize.y;
        const auto [end, failure] = std::from_chars(value.data(), value.data() + value.size(), side);
        if (failure != std::errc() || end != value.data() + value.size() || side == 0 || side > kLargestSide)
            return error("line 1", "'" + word + "' is not a size from 1 to " + std::to_string(kLargestSide) + kConvert);
    }
    // What follows 420 is where the chroma samples lie, within half a pixel; the other forms have more bits.
    const bool isKnown = value == "420" || value == "420jpeg" || value == "420mpeg2" || value == "420paldv";
    if (word[0] == 'C' && !isKnown)
        return error("line 1", "the colours are '" + word + "'; C420 with 8 bits can be read" + kConvert);
    if (word == "XCOLORRANGE=FULL") mIsFullRange = true;
    return {};
}

Result<bool> VideoFile::next() {
    const std::string line = readLine(), place = "frame " + std::to_string(mFrames + 1);
    if (line.empty() && std::feof(mStream)) {
        int status = 0;
        if (mDecoder != 0) waitpid(std::exchange(mDecoder, 0), &status, 0);
        return status == 0 ? Result<bool>(false) : error(place, "ffmpeg could not decode it");
    }
    if (line.substr(0, line.find(' ')) != "FRAME") return error(place, "does not begin with FRAME" + kConvert);
    const size_t read = std::fread(mFrame.data(), 1, mFrame.size(), mStream);
    if (read != mFrame.size())
        return error(place, "ends after " + std::to_string(read) + " of " + std::to_string(mFrame.size()) +
                                    " bytes: the file was cut short; copy or convert it again");
    ++mFrames;
    return true;
}

std::span<const std::byte> VideoFile::pixels(size_t plane) const {
    const auto bytes = [&](size_t of) { return size_t{ size(of).x } * size(of).y; };
    size_t begin = 0;
    for (size_t before = 0; before < plane; ++before) begin += bytes(before);
    return std::span(mFrame).subspan(begin, bytes(plane));
}

struct Thing {
    Owned<VertexBuffer> vertices;
    Owned<IndexBuffer> indices;

    Thing(Engine& engine, Mesh const& mesh)
            : vertices(engine.own(engine.create(mesh.vertexBuffer()))),
              indices(engine.own(engine.create(mesh.indexBuffer()))) {}

    void addTo(Scene& scene, MaterialInstance material, double4x4 const& worldFromObject) const {
        scene.add(
                { .vertices = vertices, .indices = indices, .material = material, .worldFromObject = worldFromObject });
    }
};

/// The textures of a frame's planes, and the material that makes light of them.
class Screen {
public:
    Screen(Engine& engine, VideoFile const& video, Material material)
            : mEngine(engine), mMaterial(engine.own(material)), mInstance(engine.own(engine.createInstance(material))) {
        for (size_t plane = 0; plane < mPlanes.size(); ++plane) {
            const uint2 size = video.size(plane);
            mPlanes[plane] = engine.own(engine.create(TextureDesc{
                    .format = Format::R8, .width = size.x, .height = size.y, .generateMips = true, .name = "plane" }));
        }
    }

    /// ITU-R BT.601: of the limited range, codes 16 to 235 are [0, 1], and 16 to 240 are [-0.5, 0.5] around 128.
    Result<void> setUp(bool isFullRange) {
        const float luma = isFullRange ? 255 : 219, chroma = isFullRange ? 255 : 224, black = isFullRange ? 0 : 16;
        constexpr Sampler kSampler{ .wrapU = WrapMode::ClampToEdge, .wrapV = WrapMode::ClampToEdge };
        constexpr std::array kNames{ "luma", "blueDifference", "redDifference" };
        Result<void> set = mEngine.set(mInstance, "lumaRange", float2(255 / luma, -black / luma));
        if (set) set = mEngine.set(mInstance, "chromaRange", float2(255 / chroma, 0.5f - 128 / chroma));
        if (set) set = mEngine.set(mInstance, "nits", 300);
        for (size_t plane = 0; plane < mPlanes.size() && set; ++plane)
            set = mEngine.set(mInstance, kNames[plane], mPlanes[plane], kSampler);
        return set;
    }

    void show(VideoFile const& video) {
        for (size_t plane = 0; plane < mPlanes.size(); ++plane)
            mEngine.update(mPlanes[plane], { .pixels = video.pixels(plane), .generateMips = true });
    }

    MaterialInstance instance() const { return mInstance; }

private:
    Engine& mEngine;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
    std::array<Owned<Texture>, 3> mPlanes;
};

Result<void> play(Engine& engine, VideoFile& video, uint64_t frames, const char* file) {
    const Result<Material> compiled = engine.create(MaterialDesc{ .package = materials::screen(), .name = "screen" });
    if (!compiled) return compiled.error();
    Screen screen(engine, video, *compiled);
    if (Result<void> set = screen.setUp(video.isFullRange()); !set) return set;
    const Result<Material> found = createBuiltInMaterial(engine, "lit");
    if (!found) return found.error();
    const Owned<Material> lit = engine.own(*found);
    const Owned<MaterialInstance> wood = engine.own(engine.createInstance(lit));
    if (Result<void> set = engine.set(wood, "baseColor", float3(0.35f, 0.2f, 0.1f)); !set) return set;

    const float width = 0.9f * static_cast<float>(video.size(0).x) / static_cast<float>(video.size(0).y);
    const Result<Mesh> pane = makePlane({ .width = width, .depth = 0.9f }),
                       box = makeBox({ .size = { width + 0.08f, 0.98f, 0.1f } }),
                       ground = makePlane({ .width = 20, .depth = 20 });
    for (Result<Mesh> const* mesh : { &pane, &box, &ground }) {
        if (!*mesh) return mesh->error();
    }
    const Thing front(engine, *pane), frame(engine, *box), floor(engine, *ground);
    const double4x4 turn = glm::rotate(double4x4(1), 0.35, double3(0, 1, 0));
    Scene scene(engine);
    front.addTo(scene, screen.instance(),
                glm::rotate(glm::translate(turn, double3(0, 0, 0.051)), glm::radians(90.0), double3(1, 0, 0)));
    frame.addTo(scene, wood, turn);
    floor.addTo(scene, wood, glm::translate(double4x4(1), double3(0, -0.49, 0)));
    scene.add(SunLight{ .directionWorld = { -1, -1.5f, -1 }, .illuminance = Lux{ 500 } });

    // The exposure of a lit room: a screen of 300 nits is white.
    const View view{ .camera = Camera::lookAt({ 0, 0.35, 1.7 }, { 0, -0.05, 0 }, {},
                                              { .aperture = 4, .shutterSeconds = 1.0f / 60, .iso = 400 }),
                     .size = { 320, 180 },
                     .clearColor = { 0.02f, 0.02f, 0.03f, 1 },
                     .samples = 4 };
    Renderer renderer(engine);
    const Owned<SwapChain> chain = engine.own(engine.create(SwapChainDesc{ .size = view.size }));
    uint64_t drawn = 0;
    for (; drawn < frames; ++drawn) {
        const Result<bool> isFrame = video.next();
        if (!isFrame) return isFrame.error();
        if (!*isFrame) break;
        screen.show(video);
        renderer.render(scene, view, chain);
    }
    if (drawn == 0) return Error{ ErrorCode::Corrupt, "the video has no frames" };
    const Result<Image> image = renderer.waitPixels(renderer.readPixels(chain));
    return image ? savePng(file, *image) : Result<void>(image.error());
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) return fail({ ErrorCode::InvalidArgument, "usage: video FILE [vulkan|gles] [OUT.png] [FRAMES]" });
    uint64_t frames = UINT64_MAX;
    if (argc > 4) {
        const std::string_view count = argv[4];
        const auto [end, failure] = std::from_chars(count.data(), count.data() + count.size(), frames);
        if (failure != std::errc() || end != count.data() + count.size() || frames == 0)
            return fail({ ErrorCode::InvalidArgument, "FRAMES is a whole number from 1 on" });
    }
    VideoFile video(argv[1]);
    if (const Result<void> opened = video.open(); !opened) return fail(opened.error());
    const bool isVulkan = argc > 2 && std::string_view(argv[2]) == "vulkan";
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles });
    if (!engine) return fail(engine.error());
    if (std::max(video.size(0).x, video.size(0).y) > engine->device().maxTextureSize)
        return fail({ ErrorCode::Unsupported, "the frames are larger than the textures of this device" });
    const Result<void> played = play(*engine, video, frames, argc > 3 ? argv[3] : "video.png");
    return played ? 0 : fail(played.error());
}
