// SPDX-License-Identifier: Apache-2.0
// Connections to the window system come and go within a process, and engines with them.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/windows/VirtualDisplay.h"
#include "tests/windows/WindowPicture.h"

#include <X11/Xlib.h>

#include <set>
#include <thread>

namespace filament_core {
namespace {

using test::VirtualDisplay;
using test::WindowPicture;

constexpr uint2 kWindowSize(64, 48);

struct CloseConnection {
    void operator()(Display* display) const { XCloseDisplay(display); }
};
using Connection = std::unique_ptr<Display, CloseConnection>;

class ConnectionsTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override { mServer = VirtualDisplay::start(); }

    Connection connect() const { return Connection(XOpenDisplay(mServer->name().c_str())); }
    Result<Engine> engineOn(Connection const& connection) const {
        return Engine::create({ .backend = GetParam(),
                                .workers = 0,
                                .display = NativeDisplay::x11(connection.get()),
                                .validation = true });
    }
    /// Draws into a window of its own, and compares what it shows.
    void expectWindowShowsPicture(Engine& engine, Connection const& connection, uint32_t number) const {
        const unsigned long window = mServer->openWindow(kWindowSize);
        {
            const Owned<SwapChain> chain = engine.own(engine.create(
                    SwapChainDesc{ .size = kWindowSize, .window = NativeWindow::x11(window), .name = "window" }));
            WindowPicture picture(engine);
            picture.draw(chain, kWindowSize, number);
            engine.waitIdle();
            XSync(connection.get(), 0); // the server has executed all requests
            EXPECT_EQ(mServer->pixels(window, kWindowSize), picture.pixels(chain)) << "picture " << number;
        }
        engine.waitIdle();
        test::expectNoErrors(engine);
        mServer->closeWindow(window);
    }

    std::unique_ptr<VirtualDisplay> mServer;
};

INSTANTIATE_TEST_SUITE_P(Apis, ConnectionsTest, testing::ValuesIn(test::kBothApis),
                         [](testing::TestParamInfo<Backend> const& each) { return std::string(toString(each.param)); });

// A new connection often gets the memory of the one before it.
TEST_P(ConnectionsTest, ClosedOnesDoNotReturnWithTheirAddress) {
    if (!mServer) return;
    constexpr uint32_t kRounds = 12;
    std::set<Display*> addresses;
    for (uint32_t round = 0; round < kRounds; ++round) {
        const Connection connection = connect();
        ASSERT_TRUE(connection);
        addresses.insert(connection.get());
        Result<Engine> engine = engineOn(connection);
        ASSERT_TRUE(engine) << engine.error().message;
        expectWindowShowsPicture(*engine, connection, round);
    }
    RecordProperty("addresses", static_cast<int>(addresses.size()));
#if !defined(__SANITIZE_ADDRESS__) // which does not give addresses out again
    EXPECT_LT(addresses.size(), kRounds) << "no address came back: this run did not test anything";
#endif
}

TEST_P(ConnectionsTest, AnEngineOutlivesOthersOfItsConnection) {
    if (!mServer) return;
    const Connection connection = connect();
    ASSERT_TRUE(connection);
    Result<Engine> stays = engineOn(connection);
    ASSERT_TRUE(stays) << stays.error().message;
    for (uint32_t round = 0; round < 3; ++round) {
        {
            Result<Engine> goes = engineOn(connection);
            ASSERT_TRUE(goes) << goes.error().message;
            expectWindowShowsPicture(*goes, connection, 2 * round);
        }
        expectWindowShowsPicture(*stays, connection, 2 * round + 1);
    }
}

TEST_P(ConnectionsTest, EnginesOfSeveralThreadsShareOne) {
    if (!mServer) return;
    const Connection connection = connect();
    ASSERT_TRUE(connection);
    const auto createAndDestroy = [&] {
        for (uint32_t round = 0; round < 4; ++round) {
            const Result<Engine> engine = engineOn(connection);
            EXPECT_TRUE(engine) << engine.error().message;
        }
    };
    std::thread other(createAndDestroy);
    createAndDestroy();
    other.join();
    Result<Engine> engine = engineOn(connection);
    ASSERT_TRUE(engine) << engine.error().message;
    expectWindowShowsPicture(*engine, connection, 1);
}

} // namespace
} // namespace filament_core
