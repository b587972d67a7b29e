// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/EnumNames.h"
#include "backend/layers/Trace.h"
#include "backend/stream/CommandFields.h"

#include <bit>
#include <charconv>
#include <cstring>
#include <optional>

namespace filament_core::backend {
namespace {

constexpr size_t kMaxListLength = 4096; // entries of a bind group, constants of a program

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
}

// What terminates a word: a name, a number or a handle.
bool endsWord(char c) { return c == ' ' || c == '=' || c == '{' || c == '}' || c == '[' || c == ']' || c == '"'; }

/// Reads one line. After the first error, which error() keeps, every read...() returns false.
class LineReader {
public:
    LineReader(std::string_view line, std::span<const std::byte> blob, size_t& blobUsed, CommandBuffer& memory)
            : mLeft(line), mBlob(blob), mBlobUsed(blobUsed), mMemory(memory) {}

    std::string const& error() const { return mError; }

    std::string_view word() {
        size_t length = 0;
        while (length < mLeft.size() && !endsWord(mLeft[length])) ++length;
        const std::string_view result = mLeft.substr(0, length);
        mLeft.remove_prefix(length);
        return result;
    }

    bool atEnd() const { return mLeft.empty(); }

    /// Reads " name=value" pairs until the line or the struct ends.
    template <class S>
    bool fields(S& value) {
        uint32_t seen = 0;
        while (!mLeft.empty() && !mLeft.starts_with(" }")) {
            if (!expect(' ')) return false;
            const std::string_view name = word();
            if (!expect('=') || !field(value, name, seen)) return false;
        }
        return true;
    }

private:
    template <class... Args>
    bool wrong(fmt::format_string<Args...> format, Args&&... args) {
        if (mError.empty()) mError = fmt::vformat(format, fmt::make_format_args(args...));
        return false;
    }

    bool accept(char c) {
        if (mLeft.empty() || mLeft.front() != c) return false;
        mLeft.remove_prefix(1);
        return true;
    }

    bool expect(char c) { return accept(c) || wrong("'{}' is missing before '{}'", c, mLeft.substr(0, 20)); }

    template <class S>
    bool field(S& value, std::string_view name, uint32_t& seen) {
        bool known = false, good = false;
        uint32_t bit = 1;
        visitFields(value, [&](const char* candidate, auto& target) {
            if (!known && name == candidate) {
                known = true;
                good = (seen & bit) == 0 ? read(target) : wrong("field '{}' is given twice", name);
                seen |= bit;
            }
            bit <<= 1;
        });
        return known ? good : wrong("{} has no field '{}'", kFields<S>.name, name);
    }

    bool read(bool& value) {
        const std::string_view text = word();
        value = text == "true";
        return value || text == "false" || wrong("'{}' is neither true nor false", text);
    }

    bool read(float& value) {
        const std::string_view text = word();
        if (text.starts_with("0x")) {
            uint32_t bits = 0;
            if (!number(text.substr(2), bits, 16)) return false;
            value = std::bit_cast<float>(bits);
            return true;
        }
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
        return (status == std::errc{} && end == text.data() + text.size()) || wrong("'{}' is no number", text);
    }

    template <class T>
    bool number(std::string_view text, T& value, int base = 10) {
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value, base);
        if (status == std::errc::result_out_of_range) return wrong("{} is out of range", text);
        return (status == std::errc{} && end == text.data() + text.size()) || wrong("'{}' is no number", text);
    }

    bool read(Ticket& value) { return number(word(), value.value); }

    template <class Tag>
    bool read(Handle<Tag>& value) {
        const std::string_view text = word();
        const size_t dot = text.find('.');
        uint32_t index = 0, generation = 0;
        if (dot == std::string_view::npos) return wrong("'{}' is no handle; index.generation", text);
        if (!number(text.substr(0, dot), index) || !number(text.substr(dot + 1), generation)) return false;
        value = Handle<Tag>::make(index & Handle<Tag>::kIndexMask, generation & Handle<Tag>::kMaxGeneration);
        return (value.index() == index && value.generation() == generation) || wrong("handle {} is out of range", text);
    }

    bool read(std::string_view& value) {
        if (!expect('"')) return false;
        std::string text;
        while (!mLeft.empty() && mLeft.front() != '"') {
            char c = mLeft.front();
            mLeft.remove_prefix(1);
            if (c == '\\' && !escape(c)) return false;
            text += c;
        }
        if (!expect('"')) return false;
        const std::span<std::byte> copy = text.empty() ? std::span<std::byte>{} : mMemory.allocate(text.size(), 1);
        if (!copy.empty()) std::memcpy(copy.data(), text.data(), text.size());
        value = { reinterpret_cast<const char*>(copy.data()), copy.size() };
        return true;
    }

    bool escape(char& c) { // called after the backslash was read
        if (mLeft.size() < 3 || mLeft[0] != 'x' || hexDigit(mLeft[1]) < 0 || hexDigit(mLeft[2]) < 0) {
            return wrong("an escape is \\xNN");
        }
        c = static_cast<char>(hexDigit(mLeft[1]) * 16 + hexDigit(mLeft[2]));
        mLeft.remove_prefix(3);
        return true;
    }

    bool read(std::span<const std::byte>& value) { return accept('@') ? readBlob(value) : readHex(value); }

    // Payloads are in the blob in the order of the text: no byte is read twice, and the size of the blob bounds the
    // memory.
    bool readBlob(std::span<const std::byte>& value) {
        const std::string_view text = word();
        const size_t plus = text.find('+');
        uint64_t offset = 0, size = 0;
        if (plus == std::string_view::npos) return wrong("'@{}' is no payload; @offset+size", text);
        if (!number(text.substr(0, plus), offset) || !number(text.substr(plus + 1), size)) return false;
        if (offset != mBlobUsed) return wrong("payload @{}: the next one begins at byte {}", text, mBlobUsed);
        if (size > mBlob.size() - offset)
            return wrong("payload @{}: the side file has only {} bytes", text, mBlob.size());
        mBlobUsed += size;
        return adopt(mBlob.subspan(offset, size), value);
    }

    bool readHex(std::span<const std::byte>& value) {
        const std::string_view text = word();
        if (text.size() % 2 != 0) return wrong("{} hex digits; bytes have two each", text.size());
        std::vector<std::byte> bytes(text.size() / 2);
        for (size_t i = 0; i < bytes.size(); ++i) {
            const int high = hexDigit(text[2 * i]), low = hexDigit(text[2 * i + 1]);
            if (high < 0 || low < 0) return wrong("'{}' is no byte in hex", text.substr(2 * i, 2));
            bytes[i] = static_cast<std::byte>(high * 16 + low);
        }
        return adopt<std::byte>(bytes, value);
    }

    template <class T>
    bool adopt(std::span<const T> values, std::span<const T>& value) {
        value = {};
        if (values.empty()) return true;
        const std::span<std::byte> copy = mMemory.allocate(values.size_bytes());
        std::memcpy(copy.data(), values.data(), values.size_bytes());
        value = { reinterpret_cast<const T*>(copy.data()), values.size() };
        return true;
    }

    template <class T>
    bool read(T& value) {
        if constexpr (kIsFlags<T>) {
            return readFlags(value);
        } else if constexpr (std::is_enum_v<T>) {
            const std::string_view name = word();
            const std::optional<size_t> index = enumIndex<T>(name);
            value = static_cast<T>(index.value_or(0));
            return index || wrong("'{}' is no such name", name);
        } else if constexpr (std::is_arithmetic_v<T>) {
            return number(word(), value);
        } else if constexpr (kIsArray<T>) {
            size_t count = 0;
            return list([&] {
                if (count == value.size()) return wrong("more than {} elements", value.size());
                return read(value[count++]);
            });
        } else if constexpr (kIsSpan<T>) {
            using Element = std::remove_const_t<typename T::element_type>;
            std::vector<Element> elements;
            const bool good = list([&] {
                if (elements.size() == kMaxListLength) return wrong("more than {} elements", kMaxListLength);
                return read(elements.emplace_back());
            });
            return good && adopt<Element>(elements, value);
        } else {
            static_assert(HasFields<T>, "a field of a type that traces do not know");
            return expect('{') && fields(value) && expect(' ') && expect('}');
        }
    }

    template <class T>
    bool readFlags(T& value) {
        unsigned bits = 0;
        std::string_view rest = word();
        if (rest == "0") return value = T{}, true;
        while (true) {
            const size_t bar = rest.find('|');
            const std::optional<size_t> bit = enumIndex<T>(rest.substr(0, bar));
            if (!bit) return wrong("'{}' is no such name", rest.substr(0, bar));
            bits |= 1u << *bit;
            if (bar == std::string_view::npos) break;
            rest.remove_prefix(bar + 1);
        }
        value = static_cast<T>(bits);
        return true;
    }

    template <class ReadElement>
    bool list(ReadElement&& readElement) {
        if (!expect('[')) return false;
        while (!mLeft.starts_with(" ]")) {
            if (!expect(' ') || !readElement()) return false;
        }
        mLeft.remove_prefix(2);
        return true;
    }

    std::string_view mLeft;
    std::span<const std::byte> mBlob;
    size_t& mBlobUsed;
    CommandBuffer& mMemory;
    std::string mError;
};

// Reads the fields of the command of this name; false if there is no such command.
template <class... C>
bool readCommand(std::string_view name, LineReader& line, CommandBuffer& to, TypeList<C...>) {
    const auto one = [&]<class Command>(std::type_identity<Command>) {
        if (name != kFields<Command>.name) return false;
        Command command{};
        if (line.fields(command) && line.atEnd()) to.recordAdopted(command);
        return true;
    };
    return (one(std::type_identity<C>{}) || ...);
}

std::string_view takeLine(std::string_view& text) {
    const size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

std::string readLine(std::string_view text, std::span<const std::byte> blob, size_t& blobUsed, CommandBuffer& to) {
    LineReader line(text, blob, blobUsed, to);
    const std::string_view name = line.word();
    if (!readCommand(name, line, to, Commands{})) return fmt::format("there is no command '{}'", name.substr(0, 40));
    if (!line.error().empty()) return fmt::format("{}: {}", name, line.error());
    return line.atEnd() ? std::string{} : fmt::format("{}: unexpected text after the last field", name);
}

} // namespace

Result<std::vector<CommandBuffer>> readTrace(std::string_view text, std::span<const std::byte> blob) {
    std::vector<CommandBuffer> streams;
    size_t blobUsed = 0;
    if (!text.starts_with(traceHeader())) {
        return fail(ErrorCode::Corrupt, "line 1: not a trace of this version; expected 'filament-trace 1'");
    }
    for (size_t number = 1; !text.empty(); ++number) {
        const std::string_view line = takeLine(text);
        if (number == 1 || line.empty() || line.front() == '#') continue;
        if (line == "Stream") {
            streams.emplace_back();
            continue;
        }
        if (streams.empty()) return fail(ErrorCode::Corrupt, "line {}: a command before the first 'Stream'", number);
        const std::string problem = readLine(line, blob, blobUsed, streams.back());
        if (!problem.empty()) return fail(ErrorCode::Corrupt, "line {}: {}", number, problem);
    }
    return streams;
}

} // namespace filament_core::backend
