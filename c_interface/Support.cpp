// SPDX-License-Identifier: Apache-2.0
#include "c_interface/Support.h"

#include <filament_core/Version.h>

#include <new>

namespace filament_core::c {
namespace {

thread_local std::string lastError, keptText;

} // namespace

fc_code failed(ErrorCode code, std::string message) noexcept {
    lastError = std::move(message);
    return static_cast<fc_code>(static_cast<int>(code) + 1);
}

fc_code nullArgument(const char* function, const char* argument) noexcept {
    try {
        return failed(ErrorCode::InvalidArgument, std::string(function) + ": the argument '" + argument + "' is null");
    } catch (...) {
        return failedByException();
    }
}

fc_code failedByException() noexcept {
    try {
        throw;
    } catch (BadArgument const& error) {
        return failed(ErrorCode::InvalidArgument, error.message);
    } catch (std::bad_alloc const&) {
        return failed(ErrorCode::OutOfMemory, {}); // short enough to need none
    } catch (std::exception const& error) {
        return failed(ErrorCode::Internal, error.what());
    } catch (...) {
        return failed(ErrorCode::Internal, {});
    }
}

const char* kept(std::string text) {
    keptText = std::move(text);
    return keptText.c_str();
}

uint32_t knownBytes(const char* name, uint32_t bytes, size_t known) {
    if (bytes > sizeof(uint32_t) && bytes <= known) return bytes;
    throw BadArgument{ std::string(name) + "::struct_bytes is " + std::to_string(bytes) + "; call " + name +
                       "_init() first, of a header that is no newer than the library" };
}

double4x4 cppOf(fc_double4x4 const& in) {
    double4x4 out;
    for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = in.m[i];
    return out;
}

} // namespace filament_core::c

const char* fc_last_error(void) { return filament_core::c::lastError.c_str(); }

const char* fc_version(void) { return filament_core::versionText(); }
