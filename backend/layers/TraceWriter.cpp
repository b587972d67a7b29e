// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/EnumNames.h"
#include "backend/layers/Trace.h"
#include "backend/stream/CommandFields.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>

namespace filament_core::backend {
namespace {

constexpr size_t kMaxInlineBytes = 64;

// Whether a field may be omitted because it equals its default. Floats compare by bits: -0 is not 0.
template <class T>
bool isSame(T const& value, T const& standard) {
    if constexpr (std::same_as<T, float>) {
        return std::bit_cast<uint32_t>(value) == std::bit_cast<uint32_t>(standard);
    } else if constexpr (kIsSpan<T> || std::same_as<T, std::string_view>) {
        return value.empty(); // no payload by default
    } else if constexpr (kIsArray<T>) {
        for (size_t i = 0; i < value.size(); ++i) {
            if (!isSame(value[i], standard[i])) return false;
        }
        return true;
    } else if constexpr (HasFields<T>) {
        const auto all = [&](auto const&... field) {
            return (isSame(value.*field.member, standard.*field.member) && ...);
        };
        return std::apply(all, kFields<T>.fields);
    } else {
        return value == standard;
    }
}

class Writer {
public:
    Writer(TraceText& out, size_t blobBase) : mOut(out), mBlobBase(blobBase) {}

    template <class C>
    void execute(C const& command) {
        mOut.text += kFields<C>.name;
        fields(command);
        mOut.text += '\n';
    }

private:
    template <class... Args>
    void print(fmt::format_string<Args...> format, Args&&... args) {
        fmt::vformat_to(std::back_inserter(mOut.text), format, fmt::make_format_args(args...));
    }

    // Writes " name=value" for every field that differs from its default.
    template <class S>
    void fields(S const& value) {
        const S standard{};
        const auto each = [&](auto const&... field) {
            (one(field.name, value.*field.member, standard.*field.member), ...);
        };
        std::apply(each, kFields<S>.fields);
    }

    template <class T>
    void one(const char* name, T const& value, T const& standard) {
        if (isSame(value, standard)) return;
        print(" {}=", name);
        write(value);
    }

    void write(bool value) { mOut.text += value ? "true" : "false"; }

    void write(float value) {
        if (std::isfinite(value))
            print("{}", value);
        else
            print("0x{:08x}", std::bit_cast<uint32_t>(value));
    }

    void write(std::string_view value) {
        mOut.text += '"';
        for (const char c : value) {
            const auto code = static_cast<unsigned char>(c);
            if (code < 0x20 || code >= 0x7F || c == '"' || c == '\\')
                print("\\x{:02x}", code);
            else
                mOut.text += c;
        }
        mOut.text += '"';
    }

    void write(std::span<const std::byte> value) {
        if (value.size() > kMaxInlineBytes) {
            print("@{}+{}", mBlobBase + mOut.blob.size(), value.size());
            mOut.blob.insert(mOut.blob.end(), value.begin(), value.end());
            return;
        }
        for (const std::byte byte : value) print("{:02x}", static_cast<unsigned>(byte));
    }

    template <class Tag>
    void write(Handle<Tag> value) {
        print("{}.{}", value.index(), value.generation());
    }

    void write(Ticket value) { print("{}", value.value); }

    template <class T>
    void write(T const& value) {
        if constexpr (kIsFlags<T>) {
            writeFlags(value);
        } else if constexpr (std::is_enum_v<T>) {
            mOut.text += enumName(value);
        } else if constexpr (std::is_arithmetic_v<T>) {
            print("{}", +value);
        } else if constexpr (kIsArray<T>) {
            size_t count = value.size();
            while (count > 0 && isSame(value[count - 1], typename T::value_type{})) --count;
            writeList(std::span(value.data(), count));
        } else if constexpr (kIsSpan<T>) {
            writeList(value);
        } else {
            static_assert(HasFields<T>, "a field of a type that traces do not know");
            mOut.text += '{';
            fields(value);
            mOut.text += " }";
        }
    }

    template <class T>
    void writeFlags(T value) {
        const char* separator = "";
        for (size_t bit = 0; bit < enumCount<T>(); ++bit) {
            if ((static_cast<unsigned>(value) >> bit & 1) == 0) continue;
            print("{}{}", separator, nameAt<T>(bit));
            separator = "|";
        }
        if (!*separator) mOut.text += '0';
    }

    template <class T, size_t N>
    void writeList(std::span<T, N> values) {
        mOut.text += '[';
        for (auto const& value : values) {
            mOut.text += ' ';
            write(value);
        }
        mOut.text += " ]";
    }

    TraceText& mOut;
    const size_t mBlobBase;
};

} // namespace

std::string_view traceHeader() { return "filament-trace 1\n"; }

void writeTrace(CommandView commands, TraceText& out, size_t blobBase) {
    out.text += "Stream\n";
    Writer writer(out, blobBase);
    replay(commands, writer);
}

} // namespace filament_core::backend
