// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/StreamHash.h"

#include "backend/stream/CommandFields.h"
#include "base/Hash.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace filament_core::backend {
namespace {

class StreamHasher {
public:
    template <class C>
    void execute(C const& command) {
        word(kCommandId<C>);
        add(command);
    }

    uint64_t result() const { return mState; }

private:
    void word(uint64_t value) { mState = hashCombine(mState, value); }

    void add(std::span<const std::byte> bytes) { mState = hashBytes(bytes, mState); }
    void add(std::string_view text) { mState = hashString(text, mState); }
    void add(float value) { word(std::bit_cast<uint32_t>(value)); }

    template <class Tag>
    void add(Handle<Tag> handle) {
        word(handle.bits);
    }

    void add(Ticket ticket) {
        // Tickets count up through the process: equal frames have different ones, in the same places.
        const auto found = std::ranges::find(mTickets, ticket);
        word(static_cast<uint64_t>(found - mTickets.begin()));
        if (found == mTickets.end()) mTickets.push_back(ticket);
    }

    template <class T>
    void add(T const& value) {
        if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
            word(static_cast<uint64_t>(value));
        } else if constexpr (kIsArray<T>) {
            for (auto const& element : value) add(element);
        } else if constexpr (kIsSpan<T>) {
            word(value.size());
            for (auto const& element : value) add(element);
        } else {
            static_assert(HasFields<T>, "a field of a type that hashes do not know");
            visitFields(value, [this](const char*, auto const& field) { this->add(field); });
        }
    }

    uint64_t mState = 0;
    std::vector<Ticket> mTickets; // in order of appearance; a stream has few
};

} // namespace

uint64_t hashStream(CommandView commands) {
    StreamHasher hasher;
    replay(commands, hasher);
    return hasher.result();
}

} // namespace filament_core::backend
