// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/TextureStreamer.h"

#include "backend/stream/RecordingGuards.h"
#include "base/OutOfMemory.h"
#include "base/math/Elementary.h"
#include "filament_core/engine/materials/TextureParameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace filament_core::engine {
namespace {

constexpr size_t kMostLoads = 16;

assets::Image shapeOf(backend::Format format, uint2 size, uint32_t level) {
    const uint2 begins = glm::max(size >> level, uint2(1));
    assets::Image image{ .width = begins.x, .height = begins.y, .format = format };
    image.levels = backend::fullMipCount(begins.x, begins.y);
    return image;
}

} // namespace

// ------------------------------------------------------------------------------------------------ a texture

bool TextureStreamer::Load::isDone() {
    const std::scoped_lock lock(mutex);
    return hasEnded;
}

void TextureStreamer::Load::wait() {
    std::unique_lock lock(mutex);
    ended.wait(lock, [&] { return hasEnded; });
}

uint32_t TextureStreamer::Stream::wanted() const {
    return lod < static_cast<float>(coarsest) ? static_cast<uint32_t>(lod) : coarsest;
}

double TextureStreamer::Stream::errorPixels(uint32_t level) const {
    return std::isinf(lod) ? 0 : elementary::exp2(static_cast<double>(level) - lod);
}

uint64_t TextureStreamer::Stream::bytes(uint32_t level) const {
    const assets::Image shape = shapeOf(format, size, level);
    return shape.levelOffset(shape.levels);
}

// ------------------------------------------------------------------------------------------------ what there is

TextureStreamer::~TextureStreamer() {
    for (const backend::TextureHandle texture : mOutgoing) mEngine.stream->destroy(mEngine.pending, texture);
}

void TextureStreamer::add(Texture texture, ImageStore const& store, uint32_t slot, SharedBytes const& bytes) {
    TextureState const& state = mEngine.textures.get(texture);
    assets::GltfImageStore::Texture const& source = store->textures()[slot];
    if (!state.handle || state.desc.width != source.size.x >> source.coarsest) return; // too large for the device
    const auto free = std::ranges::find(mStreams, Texture{}, &Stream::texture);
    const auto at = static_cast<size_t>(free - mStreams.begin());
    if (free == mStreams.end()) mStreams.emplace_back(), mKnown.textures.emplace_back();
    mStreams[at] = { .texture = texture,
                     .store = store,
                     .slot = slot,
                     .coarse = bytes,
                     .format = state.desc.format,
                     .size = source.size,
                     .coarsest = source.coarsest,
                     .resident = source.coarsest,
                     .target = source.coarsest,
                     .lod = std::numeric_limits<float>::infinity(),
                     .load = {} };
    mKnown.textures[at] = { state.handle, static_cast<float>(source.size.x) * static_cast<float>(source.size.y) };
}

void TextureStreamer::addMap(MaterialInstance instance, std::string const& parameter, std::string const& matrix,
                             Texture texture, uint32_t uvSet) {
    const auto found = std::ranges::find(mStreams, texture, &Stream::texture);
    if (found == mStreams.end()) return;
    scene::MaterialInstance const& state = mEngine.instances.get(instance);
    shader::MaterialPackage const& package = state.material->package;
    shader::Parameter const* const sampler = package.findParameter(parameter);
    shader::Parameter const* const transform = matrix.empty() ? nullptr : package.findParameter(matrix);
    if (!sampler) return;
    mKnown.maps[state.id].push_back({ .texture = static_cast<uint32_t>(found - mStreams.begin()),
                                      .slot = static_cast<uint32_t>(textureSlot(package, *sampler)),
                                      .uvSet = std::min(uvSet, 3u),
                                      .matrix = transform ? transform->offset : prepare::StreamedMap::kNoMatrix });
}

void TextureStreamer::addMesh(backend::BufferHandle vertices, scene::UvDensity const& density) {
    mKnown.densities[vertices.bits] = density;
}

void TextureStreamer::addClone(uint32_t source, uint32_t copy) {
    const auto found = mKnown.maps.find(source);
    if (found == mKnown.maps.end()) return;
    const std::vector<prepare::StreamedMap> maps = found->second;
    mKnown.maps[copy] = maps;
}

void TextureStreamer::dropDead() {
    bool isAnyDead = false;
    for (size_t i = 0; i < mStreams.size(); ++i) {
        Stream& stream = mStreams[i];
        if (!stream.texture || mEngine.textures.isLive(stream.texture)) continue;
        stream = {};
        mKnown.textures[i] = {};
        isAnyDead = true;
    }
    if (!isAnyDead) return;
    std::erase_if(mQueue, [&](uint32_t at) { return !mStreams[at].load; });
    const auto isDead = [&](prepare::StreamedMap const& map) { return !mKnown.textures[map.texture].handle; };
    std::erase_if(mKnown.maps, [&](auto const& entry) { return std::ranges::all_of(entry.second, isDead); });
    while (!mStreams.empty() && !mStreams.back().texture) mStreams.pop_back(), mKnown.textures.pop_back();
    if (mStreams.empty()) mKnown.densities.clear();
}

// ------------------------------------------------------------------------------------------------ frames

void TextureStreamer::beginFrame() {
    ++mFrame;
    for (const backend::TextureHandle texture : std::exchange(mOutgoing, {}))
        mEngine.stream->destroy(mEngine.pending, texture);
    dropDead();
    if (!mHasNeeds) return;
    choose();
    evict();
    takeFinished();
    request();
}

void TextureStreamer::note(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                           prepare::FramePacket const& packet) {
    const std::span<const float> needed = prepare::neededLevels(jobs, arena, scene, packet, mKnown);
    for (size_t i = 0; i < mStreams.size(); ++i) {
        Stream& stream = mStreams[i];
        if (std::isfinite(needed[i])) stream.lastSeen = mFrame;
        if (needed[i] <= stream.lod || ++stream.unseen >= kHeldFrames) stream.lod = needed[i], stream.unseen = 0;
    }
    mHasNeeds = true;
}

bool TextureStreamer::wait() {
    dropDead();
    if (!mHasNeeds) return false;
    choose();
    request(); // the next frame evicts: what it replaces ends with the frame after it
    for (const uint32_t at : mQueue) mStreams[at].load->wait();
    return !residency().isSettled;
}

/// Targets. The next finer level of the texture with the largest error comes first.
void TextureStreamer::choose() {
    uint64_t used = 0;
    mSteps.clear();
    const auto push = [&](uint32_t at) {
        Stream const& stream = mStreams[at];
        if (stream.target <= stream.wanted() || stream.hasFailed) return;
        mSteps.push_back({ static_cast<float>(stream.target) - stream.lod, at });
        std::ranges::push_heap(mSteps);
    };
    for (uint32_t i = 0; i < mStreams.size(); ++i) {
        Stream& stream = mStreams[i];
        if (!stream.texture) continue;
        stream.target = stream.hasFailed ? stream.resident : stream.coarsest;
        used += stream.bytes(stream.target);
        push(i);
    }
    mOrder.clear();
    while (!mSteps.empty()) {
        std::ranges::pop_heap(mSteps);
        const uint32_t at = mSteps.back().at;
        mSteps.pop_back();
        Stream& stream = mStreams[at];
        const uint64_t more = stream.bytes(stream.target - 1) - stream.bytes(stream.target);
        if (used + more > budgetBytes()) continue;
        used += more;
        if (stream.target-- == stream.coarsest) mOrder.push_back(at);
        push(at);
    }
    mKept.clear();
    for (uint32_t i = 0; i < mStreams.size(); ++i)
        if (mStreams[i].texture && mStreams[i].resident < mStreams[i].target) mKept.push_back(i);
    std::ranges::sort(mKept, [&](uint32_t a, uint32_t b) {
        const uint64_t seenA = mStreams[a].lastSeen, seenB = mStreams[b].lastSeen;
        return seenA != seenB ? seenA > seenB : a < b;
    });
    for (const uint32_t at : mKept) {
        Stream& stream = mStreams[at];
        const uint64_t more = stream.bytes(stream.resident) - stream.bytes(stream.target);
        if (used + more <= budgetBytes()) used += more, stream.target = stream.resident;
    }
}

/// The coarsest levels are at hand.
void TextureStreamer::evict() {
    for (uint32_t i = 0; i < mStreams.size(); ++i) {
        Stream const& stream = mStreams[i];
        if (stream.texture && stream.target == stream.coarsest && stream.resident < stream.target)
            replace(i, stream.coarsest, stream.coarse);
    }
}

void TextureStreamer::request() {
    uint64_t used = residentBytes(), onTheWay = 0;
    for (const uint32_t at : mQueue) {
        Stream const& stream = mStreams[at];
        const uint64_t bytes = stream.bytes(stream.load->level), has = stream.bytes(stream.resident);
        onTheWay += bytes;
        if (bytes > has) used += bytes - has;
    }
    const auto begin = [&](uint32_t at) {
        Stream& stream = mStreams[at];
        const uint64_t bytes = stream.bytes(stream.target), has = stream.bytes(stream.resident);
        const bool hasRoom = onTheWay == 0 || onTheWay + bytes <= 2 * uploadBytes();
        if (mQueue.size() >= kMostLoads || !hasRoom || (bytes > has && used + bytes - has > budgetBytes())) return;
        if (bytes > has) used += bytes - has;
        onTheWay += bytes;
        mQueue.push_back(at); // before the load: without memory there is none
        start(stream);
    };
    // First what makes room.
    for (uint32_t i = 0; i < mStreams.size(); ++i)
        if (mStreams[i].texture && !mStreams[i].load && mStreams[i].resident < mStreams[i].target) begin(i);
    for (const uint32_t at : mOrder)
        if (!mStreams[at].load && mStreams[at].resident > mStreams[at].target) begin(at);
}

void TextureStreamer::start(Stream& stream) {
    stream.load = std::make_shared<Load>();
    stream.load->level = stream.target;
    struct Work {
        ImageStore store;
        std::shared_ptr<Load> load;
        uint32_t slot = 0;
    };
    auto work = std::make_unique<Work>(Work{ stream.store, stream.load, stream.slot });
    mEngine.jobs.runBackground<"stream texture">([work = std::move(work)] {
        Load& load = *work->load;
        std::optional<assets::Image> image;
        std::string error;
        try {
            Result<assets::Image> decoded = work->store->decode(work->slot, load.level);
            if (decoded)
                image = std::move(*decoded);
            else
                error = decoded.error().message;
        } catch (std::exception const&) { // of std::bad_alloc the text may need memory
            error.clear();
        }
        const std::scoped_lock lock(load.mutex);
        load.image = std::move(image);
        load.error = std::move(error);
        load.hasEnded = true;
        load.ended.notify_all();
    });
}

/// In the order of the requests, up to what a frame may upload.
void TextureStreamer::takeFinished() {
    uint64_t uploaded = 0;
    std::erase_if(mQueue, [&](uint32_t at) {
        Stream& stream = mStreams[at];
        if (!stream.load->isDone()) return false;
        const uint32_t level = stream.load->level;
        const uint64_t bytes = stream.bytes(level);
        if (uploaded > 0 && uploaded + bytes > uploadBytes()) return false;
        const std::shared_ptr<Load> load = std::exchange(stream.load, {});
        if (!load->image || load->image->data.size() != bytes) {
            stream.hasFailed = true;
            mEngine.report(fmt::format("texture '{}' keeps its coarse levels: {}",
                                       mEngine.textures.get(stream.texture).name,
                                       load->error.empty() ? "out of memory" : load->error));
            return true;
        }
        // The view may have moved on. What is on the way to the target is taken, the rest would be replaced at once.
        const bool isFiner = stream.target <= level && level < stream.resident;
        const bool isCoarser = stream.resident < level && level <= stream.target;
        if (!isFiner && !isCoarser) return true;
        uploaded += bytes;
        replace(at, level, sharedBytes(load->image->data));
        return true;
    });
}

void TextureStreamer::replace(uint32_t at, uint32_t level, SharedBytes const& texels) {
    using namespace backend;
    Stream& stream = mStreams[at];
    TextureState& state = mEngine.textures.get(stream.texture);
    const assets::Image shape = shapeOf(stream.format, stream.size, level);
    DeviceTextureDesc desc = state.desc;
    desc.width = shape.width, desc.height = shape.height;
    desc.levels = static_cast<uint8_t>(shape.levels);
    mOutgoing.reserve(mOutgoing.size() + 1);
    NewHandle handle(*mEngine.stream, mEngine.stream->allocateTexture());
    AllOrNothing all(mEngine.pending);
    DeviceTextureDesc created = desc;
    created.debugName = state.name;
    mEngine.pending.record(CmdCreateTexture{ handle, created });
    mEngine.pending.keep(texels);
    for (uint32_t i = 0; i < shape.levels; ++i) {
        const uint32_t width = std::max(1u, shape.width >> i), height = std::max(1u, shape.height >> i);
        mEngine.pending.recordAdopted(
                CmdUploadTexture{ handle,
                                  static_cast<uint8_t>(i),
                                  0,
                                  1,
                                  { 0, 0, width, height },
                                  std::span(*texels).subspan(shape.levelOffset(i), shape.levelBytes(i)) });
    }
    const TextureHandle old = state.handle;
    // Marked first: what fails on the way leaves instances dirty, which costs a frame new groups and nothing else.
    mEngine.instances.forEachHeld([&](MaterialInstance instance, scene::MaterialInstance const& of) {
        if (std::ranges::find(of.textures, old, &scene::TextureBinding::texture) != of.textures.end())
            mEngine.markDirty(instance);
    });
    all.complete();
    state.handle = handle.keep();
    state.desc = desc;
    mKnown.textures[at].handle = state.handle;
    mOutgoing.push_back(old);
    stream.resident = level;
    mEngine.instances.forEachHeld([&](MaterialInstance, scene::MaterialInstance& of) {
        for (scene::TextureBinding& bound : of.textures) {
            if (bound.texture != old) continue;
            bound.texture = state.handle;
            of.texturesDirty = true;
        }
    });
}

// ------------------------------------------------------------------------------------------------ what it says

uint64_t TextureStreamer::residentBytes() const {
    uint64_t bytes = 0;
    for (Stream const& stream : mStreams)
        if (stream.texture) bytes += stream.bytes(stream.resident);
    return bytes;
}

TextureResidency TextureStreamer::residency() const {
    TextureResidency all{ .loading = static_cast<uint32_t>(mQueue.size()), .residentBytes = residentBytes() };
    all.isSettled = mQueue.empty();
    std::vector<assets::GltfImageStore const*> stores;
    double largest = 0;
    for (Stream const& stream : mStreams) {
        if (!mEngine.textures.isLive(stream.texture)) continue;
        ++all.textures;
        stores.push_back(stream.store.get());
        all.wholeBytes += stream.bytes(0);
        all.neededBytes += stream.bytes(stream.wanted());
        all.isSettled &= stream.resident == stream.target;
        const double error = stream.resident > stream.wanted() ? stream.errorPixels(stream.resident) : 0;
        if (!(error > largest)) continue;
        largest = error;
        all.largestError = fmt::format("{}, texture {}", mEngine.textures.get(stream.texture).name, stream.slot);
    }
    all.largestErrorPixels = static_cast<float>(largest);
    std::ranges::sort(stores);
    stores.erase(std::unique(stores.begin(), stores.end()), stores.end());
    for (assets::GltfImageStore const* store : stores) all.fileBytes += store->fileBytes();
    return all;
}

std::string TextureStreamer::explain() const {
    const TextureResidency now = residency();
    if (now.textures == 0) return {};
    const auto megabytes = [](uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    std::string text = fmt::format("texture streaming: {} textures, {:.1f} of {:.1f} MB on the device, {:.1f} needed, "
                                   "budget {} MB",
                                   now.textures, megabytes(now.residentBytes), megabytes(now.wholeBytes),
                                   megabytes(now.neededBytes), options.budgetMegabytes);
    if (now.loading > 0) text += fmt::format("; {} on their way", now.loading);
    if (now.largestErrorPixels > 0)
        text += fmt::format("; largest error {:.1f} pixels a texel: {}", now.largestErrorPixels, now.largestError);
    return text + "\n";
}

} // namespace filament_core::engine

namespace filament_core {

void setTextureStreaming(Engine& engine, TextureStreaming const& options) {
    const engine::PublicCall call(engine, "setTextureStreaming(Engine, TextureStreaming)");
    constexpr uint32_t kMost = 1u << 20;
    FILAMENT_ASSERT(options.budgetMegabytes >= 1 && options.budgetMegabytes <= kMost && options.uploadMegabytes >= 1 &&
                            options.uploadMegabytes <= kMost,
                    "budgets of textures are in [1, 2^20] megabytes");
    engine.impl().streamerOf().options = options;
}

TextureStreaming textureStreaming(Engine& engine) {
    const engine::PublicCall call(engine, "textureStreaming(Engine)");
    return engine.impl().streamer ? engine.impl().streamer->options : TextureStreaming{};
}

TextureResidency textureResidency(Engine& engine) {
    const engine::PublicCall call(engine, "textureResidency(Engine)");
    return engine.impl().streamer ? engine.impl().streamer->residency() : TextureResidency{};
}

bool waitForTextures(Engine& engine) {
    const engine::PublicCall call(engine, "waitForTextures(Engine)");
    bool mayChange = false;
    engine.impl().orReport("streaming textures", {}, [&] {
        if (engine.impl().streamer) mayChange = engine.impl().streamer->wait();
    });
    return mayChange;
}

engine::TextureStreamer& Engine::Impl::streamerOf() {
    if (!streamer) streamer = std::make_unique<engine::TextureStreamer>(*this);
    return *streamer;
}

} // namespace filament_core
