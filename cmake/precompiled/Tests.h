// SPDX-License-Identifier: Apache-2.0
/// What most tests include, precompiled (FILAMENT_PCH): see Rooms.h.
#include "Rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <sstream>
#include <thread>
