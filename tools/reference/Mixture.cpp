// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Mixture.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

constexpr double kMinFilmCosine = 0.03125; // as in the engine

void becomeMetal(SurfaceSample& surface, double3 color) {
    surface.metallic = 1;
    surface.f0 = color;
    surface.f90 = f90Of(color);
    surface.diffuse = double3(0.0);
    surface.diffuseTransmission.color = double3(0.0);
    surface.transmission.color = double3(0.0);
    surface.transmission.isFromInside = false;
}

void scaleDielectric(SurfaceSample& surface, double diffuse, double transmitted) {
    surface.diffuse *= diffuse;
    surface.diffuseTransmission.color *= diffuse;
    surface.transmission.color *= transmitted;
    surface.transmission.share *= transmitted;
}

/// A sheet that transmits a share is a sheet and an opaque surface side by side. Solids keep their colour.
void chooseSheet(SurfaceSample& surface, double transmitted, double u) {
    if (!surface.transmission.isThin || !(transmitted > 0) || transmitted >= 1) return;
    if (u < transmitted)
        scaleDielectric(surface, 0, 1 / transmitted);
    else
        scaleDielectric(surface, 1 / (1 - transmitted), 0);
}

double cosineInAir(SurfaceSample const& surface) {
    const double cosine = std::max(glm::dot(surface.normal, surface.view), kMinNov);
    if (!surface.transmission.isFromInside) return cosine;
    const double ior = surface.transmission.ior, sine2 = ior * ior * (1 - cosine * cosine);
    return std::sqrt(std::max(1 - sine2, 0.0));
}

double3 reflectanceBelow(FilmSample const& film, double cosine) {
    return lib::fresnelIridescent(film.outsideIor, film.ior, film.bareF0, film.thickness, cosine);
}

} // namespace

void meetPart(SurfaceSample& surface, double u) {
    if (!surface.mixture || !surface.transmits()) return;
    const MixtureSample mixture = *surface.mixture;
    surface.mixture.reset();
    const double metallic = surface.metallic, dielectric = 1 - metallic;
    if (u < metallic || dielectric <= 0) {
        becomeMetal(surface, mixture.color);
    } else {
        surface.metallic = 0;
        surface.f0 = mixture.dielectricF0;
        surface.f90 = mixture.dielectricF90;
        scaleDielectric(surface, 1 / dielectric, 1 / dielectric);
        chooseSheet(surface, mixture.transmitted, (u - metallic) / dielectric);
    }
    // The coat lies over the part that was met, not over the mixture.
    surface.coat.bareF0 = surface.f0;
}

bool isSum(SurfaceSample const& surface) {
    const bool isPartly = surface.metallic > 0 && surface.metallic < 1;
    return isPartly && surface.mixture && !surface.transmits() && !(surface.film.strength > 0);
}

double3 filmReflectance(FilmSample const& film, double cosine) {
    return reflectanceBelow(film, lib::refractedCosine(cosine, film.outsideIor));
}

void coverWithFilm(SurfaceSample& surface) {
    FilmSample& film = surface.film;
    if (!(film.strength > 0)) return;
    film.bareF0 = surface.f0;
    const double cosine = std::max(lib::refractedCosine(cosineInAir(surface), film.outsideIor), kMinFilmCosine);
    surface.f0 = glm::mix(surface.f0, lib::f0FromFresnel(reflectanceBelow(film, cosine), cosine), film.strength);
    surface.f90 = glm::mix(surface.f90, 1.0, film.strength);
}

} // namespace filament_core::reference
