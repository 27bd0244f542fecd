// SPDX-License-Identifier: MIT
// All closed forms of a glass ball or concentric shell in air. Lengths in millimetres, angles in radians; templates
// over double and Quad (include quad.h for that: it costs two seconds). Interference is left out; polarisation is in
// fresnel.h.
#pragma once

#include "verifier/optics/absorption.h"
#include "verifier/optics/birefringence.h"
#include "verifier/optics/deflection.h"
#include "verifier/optics/dispersion.h"
#include "verifier/optics/fresnel.h"
#include "verifier/optics/landing.h"
#include "verifier/optics/orb.h"
#include "verifier/optics/orders.h"
#include "verifier/optics/paraxial.h"
#include "verifier/optics/transmitted_ray.h"
#include "verifier/optics/uniaxial.h"
