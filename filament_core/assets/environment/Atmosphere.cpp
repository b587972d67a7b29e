// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/Atmosphere.h"

#include "base/math/Elementary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace filament_core::assets {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr size_t kColumnRows = 96, kColumnCosines = 256;
constexpr size_t kLightRows = 16, kLightCosines = 32;
constexpr size_t kColumnSteps = 64, kViewSteps = 40, kTableSteps = 20;
constexpr size_t kPolarSteps = 8, kAzimuthSteps = 4;    // of the sphere around a point
constexpr size_t kGroundPolar = 12, kGroundAzimuth = 6; // of the sky over the ground
constexpr double kLowestSun = 0.41; // minus the cosine from which on no point of the air sees the sun or its glow

/// e^x for x <= 0, within 1e-11 of it: vectors of it need no call, and its bits are the same everywhere. Range
/// reduction by rounding to a multiple of ln 2 with the bits of 1.5 * 2^52; Taylor's series beyond that.
inline double expOf(double x) {
    constexpr double kRound = 6755399441055744.0, kHigh = 0.693147180369123816490, kLow = 1.90821492927058770002e-10;
    x = x > -700.0 ? x : -700.0;
    const double shifted = x * std::numbers::log2e + kRound, n = shifted - kRound;
    const double r = (x - n * kHigh) - n * kLow;
    double sum = 1.0 / 362880;
    sum = sum * r + 1.0 / 40320;
    sum = sum * r + 1.0 / 5040;
    sum = sum * r + 1.0 / 720;
    sum = sum * r + 1.0 / 120;
    sum = sum * r + 1.0 / 24;
    sum = sum * r + 1.0 / 6;
    sum = sum * r + 0.5;
    sum = sum * r + 1.0;
    sum = sum * r + 1.0;
    return sum * std::bit_cast<double>((std::bit_cast<uint64_t>(shifted) + 1023) << 52);
}

AirColumns densities(double altitude) {
    const double h = std::max(altitude, 0.0);
    // Ozone: a layer around 25 km, with the shape of a triangle.
    return { expOf(-h / kRayleighHeight), expOf(-h / kMieHeight), std::max(0.0, 1 - std::fabs(h - 25e3) / 15e3) };
}

void add(AirColumns& sum, AirColumns const& more, double factor) {
    sum.rayleigh += more.rayleigh * factor;
    sum.mie += more.mie * factor;
    sum.ozone += more.ozone * factor;
}

AirColumns scaled(AirColumns const& a, double factor) {
    AirColumns result;
    add(result, a, factor);
    return result;
}

double toSphere(double radius, double cosine, double sphere) {
    return -radius * cosine + std::sqrt(std::max(0.0, radius * radius * (cosine * cosine - 1) + sphere * sphere));
}

double toGround(double radius, double cosine) {
    const double square = radius * radius * (cosine * cosine - 1) + kGroundRadius * kGroundRadius;
    return cosine < 0 && square >= 0 ? std::max(0.0, -radius * cosine - std::sqrt(square)) : -1;
}

/// A ray that leads up. Steps grow with the distance, as the air grows thinner.
AirColumns columnsUp(double radius, double cosine) {
    const double length = toSphere(radius, cosine, kTopRadius);
    AirColumns sum;
    for (size_t i = 0; i < kColumnSteps; ++i) {
        const double a = static_cast<double>(i) / kColumnSteps, b = static_cast<double>(i + 1) / kColumnSteps;
        // Two points of Gauss and Legendre in each step.
        const double begin = length * a * a, end = length * b * b, middle = (begin + end) / 2;
        const double away = (end - begin) / (2 * std::numbers::sqrt3);
        for (const double t : { middle - away, middle + away })
            add(sum, densities(std::sqrt(radius * radius + t * t + 2 * radius * cosine * t) - kGroundRadius),
                (end - begin) / 2);
    }
    return sum;
}

/// As in Bruneton and Neyret 2008, section 4: rows by the distance to the horizon, columns by that to the top.
struct ColumnPlace {
    double row, cosine; // in [0, 1]
};

double horizonDistance(double radius) {
    return std::sqrt(std::max(0.0, radius * radius - kGroundRadius * kGroundRadius));
}

ColumnPlace columnPlace(double radius, double cosine) {
    const double longest = horizonDistance(kTopRadius), distance = horizonDistance(radius);
    const double least = kTopRadius - radius, most = distance + longest;
    return { distance / longest, (toSphere(radius, cosine, kTopRadius) - least) / (most - least) };
}

struct Between {
    size_t index;
    double share;
};

Between between(double place, size_t count) {
    const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(count - 1);
    const size_t index = std::min(static_cast<size_t>(at), count - 2);
    return { index, at - static_cast<double>(index) };
}

AirColumns tableColumns(Atmosphere const& air, double radius, double cosine) {
    const ColumnPlace place = columnPlace(radius, cosine);
    const Between row = between(place.row, kColumnRows), column = between(place.cosine, kColumnCosines);
    AirColumns const* const low = &air.columns[row.index * kColumnCosines + column.index];
    AirColumns const* const high = low + kColumnCosines;
    AirColumns sum = scaled(low[0], (1 - row.share) * (1 - column.share));
    add(sum, low[1], (1 - row.share) * column.share);
    add(sum, high[0], row.share * (1 - column.share));
    add(sum, high[1], row.share * column.share);
    return sum;
}

/// Sun and horizon change most where the sun is near it.
double cosinePlace(double sunCosine) {
    const double root = std::copysign(std::sqrt(std::fabs(sunCosine)), sunCosine), lowest = std::sqrt(kLowestSun);
    return (root + lowest) / (1 + lowest);
}

double cosineOfPlace(double place) {
    const double lowest = std::sqrt(kLowestSun), root = place * (1 + lowest) - lowest;
    return std::copysign(root * root, root);
}

double radiusOfRow(size_t row) {
    const double share = static_cast<double>(row) / (kLightRows - 1);
    return kGroundRadius + share * share * (kTopRadius - kGroundRadius);
}

Spectrum furtherLight(Atmosphere const& air, double radius, double sunCosine) {
    const Between row =
            between(std::sqrt(std::max(0.0, radius - kGroundRadius) / (kTopRadius - kGroundRadius)), kLightRows);
    const Between column = between(cosinePlace(sunCosine), kLightCosines);
    Spectrum const* const low = &air.multiple[row.index * kLightCosines + column.index];
    Spectrum const* const high = low + kLightCosines;
    Spectrum result;
    for (size_t b = 0; b < kBands; ++b)
        result[b] = (low[0][b] * (1 - column.share) + low[1][b] * column.share) * (1 - row.share) +
                    (high[0][b] * (1 - column.share) + high[1][b] * column.share) * row.share;
    return result;
}

/// Share of the disc above the horizon of a point: a smooth step over its diameter.
double visibleDisc(double radius, double sunCosine) {
    const double sine = std::min(kGroundRadius / radius, 1.0), horizon = -std::sqrt(1 - sine * sine);
    const double x = std::clamp((sunCosine - horizon) / (2 * sine * kSunRadius) + 0.5, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

Spectrum sunlightThrough(Atmosphere const& air, Medium const& medium, double radius, double sunCosine) {
    const double visible = visibleDisc(radius, sunCosine);
    if (visible <= 0) return {};
    const double sine = std::min(kGroundRadius / radius, 1.0), horizon = -std::sqrt(1 - sine * sine);
    Spectrum light = transmittance(medium, tableColumns(air, radius, std::max(sunCosine, horizon)));
    for (double& band : light) band *= visible;
    return light;
}

struct Ray {
    double radius, cosine, sunCosine, viewSun; // cosines with the zenith of the start, and with each other
    double end;
    bool hitsGround;
};

Ray rayOf(double radius, double3 direction, double3 sun, double meters) {
    const double ground = toGround(radius, direction.y), top = toSphere(radius, direction.y, kTopRadius);
    const double end = ground >= 0 ? ground : top;
    return {
        radius, direction.y, sun.y, glm::dot(direction, sun), std::min(end, meters), ground >= 0 && ground <= meters
    };
}

struct Place {
    double radius, sunCosine;
};

Place along(Ray const& ray, double t) {
    const double radius = std::sqrt(std::max(1.0, ray.radius * ray.radius + t * t + 2 * ray.radius * ray.cosine * t));
    return { std::clamp(radius, kGroundRadius, kTopRadius),
             std::clamp((ray.radius * ray.sunCosine + t * ray.viewSun) / radius, -1.0, 1.0) };
}

/// The share of a step's light that reaches the start of a ray, in closed form, as in Hillaire 2020, section 5.5; times
/// 1 / extinction.
struct Step {
    double kept, seen;
};

Step stepOf(double extinction, double meters) {
    const double depth = extinction * meters, kept = expOf(-depth);
    return { kept, depth > 1e-6 ? (1 - kept) / extinction : meters };
}

/// further(radius, sunCosine): the mean light of the even orders around a point, 1/sr.
/// Even: the light in Atmosphere::even, for the tables, where that of aerosols is even too. Otherwise aerosols scatter
/// the beam by their phase function, and the whole medium weakens it; what they scatter straight on after that is even.
template <bool Even, class Further>
ScatteredLight march(Atmosphere const& air, Ray const& ray, size_t steps, Further const& further) {
    ScatteredLight light;
    light.transmittance.fill(1);
    Spectrum kept = light.transmittance; // in the even medium
    for (size_t i = 0; i < steps; ++i) {
        const double a = static_cast<double>(i) / static_cast<double>(steps);
        const double b = static_cast<double>(i + 1) / static_cast<double>(steps);
        const double meters = ray.end * (b * b - a * a);
        const Place at = along(ray, ray.end * (a * a + b * b) / 2);
        const AirColumns density = densities(at.radius - kGroundRadius);
        const Spectrum sun = sunlightThrough(air, air.even, at.radius, at.sunCosine);
        const Spectrum around = further(at.radius, at.sunCosine);
        for (size_t k = 0; k < kBands; ++k) {
            const double rayleigh = air.even.rayleigh[k] * density.rayleigh;
            const double mie = air.even.mieScattering[k] * density.mie;
            const double others = rayleigh + air.even.ozone[k] * density.ozone;
            const Step step = stepOf(others + air.even.mieExtinction[k] * density.mie, meters);
            const double seen = kept[k] * step.seen;
            light.rayleigh[k] += seen * rayleigh * sun[k];
            light.further[k] += seen * (rayleigh + mie) * around[k];
            kept[k] *= step.kept;
            if constexpr (Even) {
                light.mie[k] += seen * mie * sun[k];
            } else {
                const Step whole = stepOf(others + air.medium.mieExtinction[k] * density.mie, meters);
                const double seenWhole = light.transmittance[k] * whole.seen;
                light.mie[k] += seenWhole * air.medium.mieScattering[k] * density.mie * sun[k];
                light.further[k] += (seen - seenWhole) * mie * sun[k] / (4 * kPiD);
                light.transmittance[k] *= whole.kept;
            }
        }
    }
    light.even = kept;
    return light;
}

/// Calls at(direction, solid angle) for the middles of cells of a band of polar angles; half of a sphere that is
/// symmetric about the plane of the sun, counted twice.
template <class Visit>
void overHalfSphere(double fromPolar, double toPolar, size_t polars, size_t azimuths, Visit const& at) {
    for (size_t j = 0; j < polars; ++j) {
        const double width = (toPolar - fromPolar) / static_cast<double>(polars);
        const double begin = fromPolar + width * static_cast<double>(j), polar = begin + width / 2;
        const double solid =
                2 * kPiD / static_cast<double>(azimuths) * (elementary::cos(begin) - elementary::cos(begin + width));
        for (size_t i = 0; i < azimuths; ++i) {
            const double azimuth = kPiD * (static_cast<double>(i) + 0.5) / static_cast<double>(azimuths);
            const double sine = elementary::sin(polar);
            at(double3(sine * elementary::cos(azimuth), elementary::cos(polar), sine * elementary::sin(azimuth)),
               solid);
        }
    }
}

double3 sunOf(double cosine) { return { std::sqrt(std::max(0.0, 1 - cosine * cosine)), cosine, 0 }; }

constexpr auto kEvenLight = [](double, double) {
    Spectrum one;
    one.fill(1);
    return one;
};

/// What the sky sends to the ground, over pi: light of the first order by place of the sun, and the share of an even
/// light in the air.
struct GroundLight {
    std::vector<Spectrum> first;
    Spectrum share{};
};

GroundLight groundLight(Atmosphere const& air) {
    GroundLight ground{ std::vector<Spectrum>(kLightCosines) };
    for (size_t i = 0; i < kLightCosines; ++i) {
        const double3 sun = sunOf(cosineOfPlace(static_cast<double>(i) / (kLightCosines - 1)));
        Spectrum share{};
        overHalfSphere(0, kPiD / 2, kGroundPolar / 2, kAzimuthSteps, [&](double3 direction, double solid) {
            const Ray ray = rayOf(kGroundRadius, direction, sun, 1e9);
            const ScatteredLight light = march<true>(air, ray, kTableSteps, kEvenLight);
            for (size_t k = 0; k < kBands; ++k) {
                const double weight = solid * direction.y / kPiD;
                ground.first[i][k] += weight * (light.rayleigh[k] + light.mie[k]) / (4 * kPiD);
                share[k] += weight * light.further[k];
            }
        });
        ground.share = share;
    }
    return ground;
}

Spectrum mixed(std::vector<Spectrum> const& table, double sunCosine) {
    const Between at = between(cosinePlace(sunCosine), kLightCosines);
    Spectrum result;
    for (size_t k = 0; k < kBands; ++k)
        result[k] = table[at.index][k] * (1 - at.share) + table[at.index + 1][k] * at.share;
    return result;
}

/// Hillaire 2020, equations 5 to 10: light of the second order around a point, and the share f of an even light that
/// its surroundings send back; all orders are second / (1 - f). Here the ground sends back its share too.
Spectrum allFurtherOrders(Atmosphere const& air, GroundLight const& ground, double radius, double sunCosine) {
    Spectrum second{}, share{};
    const double3 sun = sunOf(sunCosine);
    overHalfSphere(0, kPiD, kPolarSteps, kAzimuthSteps, [&](double3 direction, double solid) {
        const Ray ray = rayOf(radius, direction, sun, 1e9);
        const ScatteredLight light = march<true>(air, ray, kTableSteps, kEvenLight);
        const double weight = solid / (4 * kPiD);
        for (size_t k = 0; k < kBands; ++k) {
            second[k] += (light.rayleigh[k] + light.mie[k]) / (4 * kPiD) * weight;
            share[k] += light.further[k] * weight;
        }
        if (!ray.hitsGround) return;
        const double cosine = along(ray, ray.end).sunCosine;
        const Spectrum direct = sunlightThrough(air, air.even, kGroundRadius, cosine),
                       sky = mixed(ground.first, cosine);
        for (size_t k = 0; k < kBands; ++k) {
            const double seen = air.groundAlbedo[k] * light.even[k] * weight;
            second[k] += seen * (direct[k] * std::max(cosine, 0.0) / kPiD + sky[k]);
            share[k] += seen * ground.share[k];
        }
    });
    for (size_t k = 0; k < kBands; ++k) second[k] /= std::max(1 - share[k], 1e-3);
    return second;
}

Spectrum groundIrradiance(Atmosphere const& air, double sunCosine) {
    Spectrum sum{};
    const double3 sun = sunOf(sunCosine);
    overHalfSphere(0, kPiD / 2, kGroundPolar, kGroundAzimuth, [&](double3 direction, double solid) {
        const ScatteredLight light = scatteredLight(air, kGroundRadius, direction, sun);
        const double cosine = glm::dot(direction, sun);
        for (size_t k = 0; k < kBands; ++k)
            sum[k] += (light.rayleigh[k] * rayleighPhase(cosine) + light.mie[k] * miePhase(cosine) + light.further[k]) *
                      solid * direction.y;
    });
    return sum;
}

Spectrum bandsOf(float3 rgb) {
    Spectrum result;
    for (size_t k = 0; k < kBands; ++k)
        result[k] = kBandNanometers[k] < 490 ? rgb.z : kBandNanometers[k] < 600 ? rgb.y : rgb.x;
    return result;
}

void setMedium(Atmosphere& air, AtmosphereOptions const& options) {
    // Cross-sections of Serdyuchenko et al. 2014 at the wavelengths of the bands, times 300 Dobson units in the layer.
    constexpr Spectrum kOzone{ 0.043e-6, 0.183e-6, 0.769e-6, 1.702e-6, 2.364e-6, 2.111e-6, 1.145e-6, 0.509e-6 };
    constexpr double kRayleigh = 1.24062e-6, kMiddle = 0.55; // 1/m at 1 micrometre: Penndorf 1957; micrometres
    const double air550 = options.air * kRayleigh * elementary::pow(kMiddle, -4.0);
    const double haze = (options.turbidity - 1) * air550 * kRayleighHeight / kMieHeight;
    Medium& medium = air.medium;
    for (size_t k = 0; k < kBands; ++k) {
        const double micrometers = kBandNanometers[k] / 1000;
        medium.rayleigh[k] = options.air * kRayleigh * elementary::pow(micrometers, -4.0);
        // The exponent 1.3 of Angstrom 1929 is that of continental aerosols, as in Preetham et al. 1999, appendix A.1.
        medium.mieExtinction[k] = haze * elementary::pow(micrometers / kMiddle, -1.3);
        medium.mieScattering[k] = medium.mieExtinction[k] * options.mieAlbedo;
        medium.ozone[k] = options.ozone * kOzone[k];
    }
    // The mean cosine of Cornette and Shanks's function.
    constexpr double g = kMieAsymmetry, kMeanCosine = 3 * g * (4 + g * g) / (5 * (2 + g * g));
    air.even = medium;
    for (size_t k = 0; k < kBands; ++k) {
        air.even.mieExtinction[k] -= kMeanCosine * medium.mieScattering[k];
        air.even.mieScattering[k] -= kMeanCosine * medium.mieScattering[k];
    }
    air.groundAlbedo = bandsOf(options.groundAlbedo);
}

void setColumns(Atmosphere& air, jobs::JobSystem& jobs) {
    air.columns.resize(kColumnRows * kColumnCosines);
    jobs::parallelFor<"air">(jobs, kColumnRows, 4, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            const double longest = horizonDistance(kTopRadius);
            const double distance = longest * static_cast<double>(row) / (kColumnRows - 1);
            const double radius = std::min(std::sqrt(distance * distance + kGroundRadius * kGroundRadius), kTopRadius);
            const double least = kTopRadius - radius, most = distance + longest;
            for (size_t i = 0; i < kColumnCosines; ++i) {
                const double length = least + (most - least) * static_cast<double>(i) / (kColumnCosines - 1);
                const double cosine =
                        length > 0 ? (longest * longest - distance * distance - length * length) / (2 * radius * length)
                                   : 1;
                // No ray of the table is below the horizon of its start.
                const double lowest = -distance / radius;
                air.columns[row * kColumnCosines + i] = columnsToTop(radius, std::clamp(cosine, lowest, 1.0));
            }
        }
    });
}

} // namespace

double3 rgbOf(Spectrum const& spectrum) {
    double3 sum(0.0);
    for (size_t k = 0; k < kBands; ++k) sum += kBandRgb[k] * spectrum[k];
    return sum;
}

double rayleighPhase(double cosine) { return 3 / (16 * kPiD) * (1 + cosine * cosine); }

double miePhase(double cosine) {
    constexpr double g = kMieAsymmetry;
    const double square = 1 + g * g - 2 * g * cosine;
    return 3 / (8 * kPiD) * (1 - g * g) * (1 + cosine * cosine) / ((2 + g * g) * square * std::sqrt(square));
}

AirColumns columnsToTop(double radius, double cosZenith) {
    if (cosZenith >= 0) return columnsUp(radius, cosZenith);
    // Down to the lowest point of the ray and up again; what lies behind the start is taken off.
    const double lowest = std::max(radius * std::sqrt(std::max(0.0, 1 - cosZenith * cosZenith)), kGroundRadius);
    AirColumns sum = scaled(columnsUp(lowest, 0), 2);
    add(sum, columnsUp(radius, -cosZenith), -1);
    return sum;
}

Spectrum transmittance(Medium const& medium, AirColumns const& columns) {
    Spectrum result;
    for (size_t k = 0; k < kBands; ++k)
        result[k] = expOf(-(medium.rayleigh[k] * columns.rayleigh + medium.mieExtinction[k] * columns.mie +
                            medium.ozone[k] * columns.ozone));
    return result;
}

Spectrum sunlight(Atmosphere const& air, double radius, double sunCosZenith) {
    return sunlightThrough(air, air.medium, radius, sunCosZenith);
}

Spectrum skyIrradiance(Atmosphere const& air, double sunCosZenith) { return mixed(air.irradiance, sunCosZenith); }

ScatteredLight scatteredLight(Atmosphere const& air, double radius, double3 direction, double3 sun, double meters) {
    const Ray ray = rayOf(radius, direction, sun, meters);
    ScatteredLight light =
            march<false>(air, ray, kViewSteps, [&](double r, double cosine) { return furtherLight(air, r, cosine); });
    if (!ray.hitsGround || air.irradiance.empty()) return light;
    const Place end = along(ray, ray.end);
    const Spectrum direct = sunlight(air, kGroundRadius, end.sunCosine), sky = skyIrradiance(air, end.sunCosine);
    for (size_t k = 0; k < kBands; ++k)
        light.further[k] +=
                light.even[k] * air.groundAlbedo[k] / kPiD * (direct[k] * std::max(end.sunCosine, 0.0) + sky[k]);
    return light;
}

Atmosphere makeAtmosphere(AtmosphereOptions const& options, jobs::JobSystem& jobs) {
    Atmosphere air;
    setMedium(air, options);
    setColumns(air, jobs);
    const GroundLight ground = groundLight(air);
    std::vector<Spectrum> multiple(kLightRows * kLightCosines);
    jobs::parallelFor<"sky light">(jobs, multiple.size(), 8, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            multiple[i] = allFurtherOrders(air, ground, radiusOfRow(i / kLightCosines),
                                           cosineOfPlace(static_cast<double>(i % kLightCosines) / (kLightCosines - 1)));
    });
    air.multiple = std::move(multiple);
    std::vector<Spectrum> irradiance(kLightCosines);
    jobs::parallelFor<"sky ground">(jobs, irradiance.size(), 2, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            irradiance[i] = groundIrradiance(air, cosineOfPlace(static_cast<double>(i) / (kLightCosines - 1)));
    });
    air.irradiance = std::move(irradiance);
    return air;
}

} // namespace filament_core::assets
