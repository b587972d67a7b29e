// SPDX-License-Identifier: Apache-2.0
/// Driver: replays command streams on one device.
///   Thread  created, used and destroyed on one thread, the driver thread; info() and statistics() from any.
///   Fails   a broken command stream is a bug of the caller (layers/Validated names it). Failures of the device (out of
///           memory, a shader that does not compile, a lost device) are reported to ResultSink::onError. The stream
///           continues without that object: draws with it are skipped.
#pragma once

#include "backend/api/Commands.h"

#include <filament_core/Backend.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace filament_core::backend {

/// "OpenGL ES": the name of the API, for messages.
const char* apiName(Backend backend);

enum class ShaderLanguage : uint8_t { SpirV, Essl310 };

struct DeviceLimits {
    uint32_t maxTextureSize = 2048;
    uint32_t max3DTextureSize = 256; ///< texels a side of a 3D texture
    uint32_t maxColorAttachments = 4;
    uint32_t maxUniformBlockBytes = 16384;
    uint32_t uniformOffsetAlignment = 256;  ///< power of two
    uint32_t maxTextureUnits = 16;          ///< sampled textures of one stage
    uint32_t maxStorageBuffers = 4;         ///< of one program
    uint32_t maxFragmentStorageBuffers = 4; ///< of those, in the fragment stage; OpenGL ES 3.1 guarantees none
    uint32_t maxStorageBlockBytes = 1u << 27;
    uint32_t storageOffsetAlignment = 256; ///< power of two
    uint32_t maxDispatchGroups = 65535;    ///< in each direction
    uint32_t maxGroupInvocations = 128;    ///< of one work group
    uint32_t maxGroupBytes = 16384;        ///< shared memory of one work group
    uint32_t maxVertexAttributes = 16;
    uint32_t maxSamples = 4;
    float maxAnisotropy = 1;
};

struct DeviceFeatures {
    /// Subpass input or framebuffer fetch: PassLayout::subpassCount > 1. Also false where that costs more than it
    /// saves.
    bool mergedPasses = false;
    bool timers = false;
    /// BC1..BC7. Linear BC6H and BC7 are sampled to the bits of textures of their decoded texels.
    bool blockCompression = false;
    bool exactSrgbBlocks = false; ///< so is BC7Srgb
    bool depthClamp = false;
    bool lastVertexProvokes = false; ///< a flat input has the value of the primitive's last vertex; else of its first
    bool depthResolve = false;       ///< PassLayout::resolvesDepth
    bool textureViews = false;       ///< bind groups may show a part of a texture (BindGroupEntry::range)
    bool cubeArrays = false;         ///< TextureKind::CubeArray
    bool sharedMemory = false;       ///< DeviceTextureDesc::placedOn
    bool srgbAttachments = false;    ///< passes can store the bytes of an sRGB format (attachmentFormat())
    bool primitiveIds = false;       ///< gl_PrimitiveID in fragment shaders
    bool halfFloatShaders = false; ///< 16-bit floats in fragment shaders: float16_t in SPIR-V; ESSL has mediump always
};

/// Properties of a device; constant for the life of the driver.
struct DeviceInfo {
    Backend backend = Backend::Null;
    ShaderLanguage shaderLanguage = ShaderLanguage::SpirV;
    std::string deviceName; ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driverName; ///< "Mesa 22.3.6" and the API version
    DeviceLimits limits;
    DeviceFeatures features;
};

/// Running totals since the driver was created.
struct DriverStatistics {
    uint64_t commands = 0;
    uint64_t draws = 0;
    uint64_t dispatches = 0;
    uint64_t pipelinesCreated = 0;
    uint64_t programsCreated = 0;
    uint64_t programsFromCache = 0;  ///< of programsCreated: taken from DriverOptions::cacheDirectory, not compiled
    uint64_t pipelinesFromCache = 0; ///< of pipelinesCreated, if the device reports it
    uint64_t passes = 0;
    uint64_t pipelinesCreatedInPasses = 0;               ///< late creations: each one is a hitch
    uint64_t deviceBytes = 0;                            ///< memory now allocated for buffers and textures
    uint64_t presents = 0;                               ///< images that reached a window
    std::chrono::steady_clock::time_point lastPresent{}; ///< when the window system had taken the last of them
};

enum class DriverErrorKind : uint8_t { Validation, ShaderCompile, OutOfMemory, DeviceLost, Other };

/// Receives the driver's results. Called on the driver thread only; implementations return quickly. A read-back comes
/// after all timers that ended before it in the stream: the times of a frame are available with its pixels.
class ResultSink {
public:
    virtual ~ResultSink() = default;
    virtual void onReadback(Ticket ticket, std::span<const std::byte> bytes) = 0; ///< no bytes: reported as an error
    virtual void onTimer(Ticket ticket, uint64_t nanoseconds) = 0;
    /// One line: what failed, on which object (debug name), and how to fix it.
    virtual void onError(DriverErrorKind kind, std::string_view message) = 0;
};

class Driver {
public:
    virtual ~Driver() = default;
    virtual DeviceInfo const& info() const = 0;
    virtual void execute(CommandView commands) = 0;
    /// Returns when the device has finished everything and every ticket has a result.
    virtual void waitIdle() = 0;
    virtual DriverStatistics statistics() const = 0;
};

struct DriverOptions {
    std::string requireDevice; ///< case-insensitive part of DeviceInfo::deviceName; empty: the first usable one
    bool validation = false;   ///< Vulkan layers with synchronization validation; KHR_debug on GLES -> onError
    NativeDisplay display{};   ///< of the windows of CmdCreateSurface; none: there are none, and no window system
    /// The folder that keeps compiled programs between runs, one file per device, at most kProgramCacheBytes; empty:
    /// none. Read when the driver is created, written when it ends.
    std::filesystem::path cacheDirectory{};
    bool selfTest = false; ///< reject a driver that draws a small known image wrong: backend/create/SelfTest.h
    /// The folder of the file that names the drivers which passed, so that they are not tested again; empty: none.
    std::filesystem::path selfTestNotes{};
};
inline constexpr uint64_t kProgramCacheBytes = 64u << 20;

} // namespace filament_core::backend
