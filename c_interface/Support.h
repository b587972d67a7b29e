// SPDX-License-Identifier: Apache-2.0
/// What Interface.cpp needs between the two languages: values in both directions, errors as codes, text that is kept.
///   Thread  any; the last error and the kept text are each thread's own.
///   Fails   nothing throws through a function of the interface: std::bad_alloc is FC_OUT_OF_MEMORY, everything else
///           FC_INTERNAL.
#pragma once

#include <filament_core.h>
#include <filament_core/filament_core.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace filament_core::c {

/// Keeps the reason for fc_last_error().
fc_code failed(ErrorCode code, std::string message) noexcept;
fc_code nullArgument(const char* function, const char* argument) noexcept;
/// What is thrown now, as a code.
fc_code failedByException() noexcept;
/// Until the next one on this thread.
const char* kept(std::string text);

/// How much of a struct the caller knows; ends in an error (thrown) if that is not possible.
uint32_t knownBytes(const char* name, uint32_t bytes, size_t known);
template <class Member, class Struct>
bool isThere(uint32_t bytes, Member const* member, Struct const* whole) {
    return static_cast<size_t>(reinterpret_cast<const std::byte*>(member + 1) -
                               reinterpret_cast<const std::byte*>(whole)) <= bytes;
}

/// An error that a conversion found.
struct BadArgument {
    std::string message;
};

inline std::string_view textOf(const char* text) { return text ? text : ""; }
inline uint2 cppOf(fc_uint2 in) { return { in.x, in.y }; }
inline float2 cppOf(fc_float2 in) { return { in.x, in.y }; }
inline float3 cppOf(fc_float3 in) { return { in.x, in.y, in.z }; }
inline float4 cppOf(fc_float4 in) { return { in.x, in.y, in.z, in.w }; }
inline double3 cppOf(fc_double3 in) { return { in.x, in.y, in.z }; }
double4x4 cppOf(fc_double4x4 const& in);
inline uint32_t cppOf(uint32_t in) { return in; }

template <class C, class Cpp>
C cOf(Cpp const& in) {
    if constexpr (std::is_same_v<C, const char*>) {
        return kept(std::string(in));
    } else if constexpr (std::is_enum_v<C> || std::is_arithmetic_v<C>) {
        return static_cast<C>(in);
    } else if constexpr (std::is_same_v<C, fc_float2> || std::is_same_v<C, fc_uint2>) {
        return { in.x, in.y };
    } else if constexpr (std::is_same_v<C, fc_float3> || std::is_same_v<C, fc_double3>) {
        return { in.x, in.y, in.z };
    } else if constexpr (std::is_same_v<C, fc_float4>) {
        return { in.x, in.y, in.z, in.w };
    } else if constexpr (std::is_same_v<C, fc_double4x4>) {
        C out{};
        for (int i = 0; i < 16; ++i) out.m[i] = in[i / 4][i % 4];
        return out;
    } else if constexpr (std::is_same_v<C, fc_box>) {
        return { cOf<fc_double3>(in.min), cOf<fc_double3>(in.max) };
    } else {
        return { in.bits }; // a handle
    }
}

/// Runs what returns a code.
template <class Call>
fc_code guarded(Call const& call) noexcept {
    try {
        return call();
    } catch (...) {
        return failedByException();
    }
}

/// Runs what returns a value; after an error it is zero.
template <class Value, class Call>
Value valueOr(Call const& call) noexcept {
    try {
        return call();
    } catch (...) {
        failedByException();
        if constexpr (std::is_same_v<Value, const char*>) return "";
        return Value{};
    }
}

inline fc_code codeOf(Result<void> const& done) {
    return done ? FC_OK : failed(done.error().code, done.error().message);
}

template <class T>
struct IsResult : std::false_type {};
template <class T>
struct IsResult<Result<T>> : std::true_type {};

template <class T>
auto resultOf(T&& value) {
    if constexpr (IsResult<std::decay_t<T>>::value)
        return std::forward<T>(value);
    else
        return Result<std::decay_t<T>>(std::forward<T>(value));
}

/// `made`: an object of C++, or a Result of one. The caller of C owns it.
template <class Made, class Object>
fc_code giveObject(Made&& made, Object** out) {
    auto result = resultOf(std::forward<Made>(made));
    if (!result) return failed(result.error().code, result.error().message);
    *out = new Object{ std::move(*result) };
    return FC_OK;
}

template <class Made, class C>
fc_code giveHandle(Made&& made, C* out) {
    auto result = resultOf(std::forward<Made>(made));
    if (!result) return failed(result.error().code, result.error().message);
    *out = cOf<C>(*result);
    return FC_OK;
}

} // namespace filament_core::c
