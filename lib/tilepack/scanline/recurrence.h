#pragma once

#include <array>
#include <cmath>
#include <span>

/// The recurrences of [Cou] as formulas: one step, its exact error, the bound of the error after n steps.
///
/// Along a scanline a texture coordinate is f(n) = (an + b)/(cn + d), n = 0, 1, 2, …. Walked from the near
/// end, c <= 0 and cn + d > 0. The progressive error of a sequence f_0 = f(0), f_1, f_2, … is counted in
/// pixels of the screen: e = n - F(f_n), with F the inverse of f, so f_n is the right value for the place e
/// pixels back.
///
/// Why the bounds do not depend on a and b: f = a/c + (b - ad/c)/(cn + d) is an affine image of 1/(cn + d),
/// and an Euler or a Newton step taken after an affine change of y is the step taken before it, changed
/// likewise; so F(f_n) is the same number for both.
///
/// All templates work for float, double and long double. Nothing is checked.
namespace tilepack {

// ---- f(n) = 1/(cn + d)

/// 1/(cn + d) one pixel on, by first-order prediction.   [Cou, Eq. 3.4]
template <class Real>
constexpr Real euler1_step(Real y, Real c) {
  return y - c * y * y;
}

/// The same to second order.   [Cou, Eq. 3.5]
template <class Real>
constexpr Real euler2_step(Real y, Real c) {
  return y - c * y * y + c * c * y * y * y;
}

/// One Newton-Raphson step towards 1 / next_denominator, next_denominator = c(x + 1) + d.   [Cou, Eq. 4.2]
template <class Real>
constexpr Real newton_step(Real y, Real next_denominator) {
  return (2 - next_denominator * y) * y;
}

// ---- f(n) = (an + b)/(cn + d)

template <class Real>
struct FractionalLinear {
  Real a = 0, b = 0, c = 0, d = 1;

  constexpr Real determinant() const { return a * d - b * c; } ///< 0: f is the constant b/d
  constexpr Real value(Real n) const { return (a * n + b) / (c * n + d); }
  constexpr Real inverse(Real y) const { return (b - d * y) / (c * y - a); } ///< F, where D != 0
};

/// Coefficients p[0] + p[1] y + p[2] y² (+ p[3] y³) of one step; D = ad - bc != 0.   [Cou, Eq. 5.3 to 5.5]
template <class Real>
constexpr std::array<Real, 3> euler1_polynomial(const FractionalLinear<Real>& f) {
  const Real r = 1 / f.determinant();
  return {f.a * f.a * r, 1 - 2 * f.a * f.c * r, f.c * f.c * r};
}

template <class Real>
constexpr std::array<Real, 4> euler2_polynomial(const FractionalLinear<Real>& f) {
  // (cy-a)²/D + c(cy-a)³/D², expanded.
  const Real r = 1 / f.determinant();
  const Real s = f.c * r * r;
  return {f.a * f.a * r - s * f.a * f.a * f.a, 1 - 2 * f.a * f.c * r + 3 * s * f.a * f.a * f.c,
          f.c * f.c * r - 3 * s * f.a * f.c * f.c, s * f.c * f.c * f.c};
}

/// The step from pixel x to x + 1; each coefficient is an arithmetic progression in x.
template <class Real>
constexpr std::array<Real, 3> newton_polynomial(const FractionalLinear<Real>& f, Real x) {
  const Real r = 1 / f.determinant();
  return {(f.a * f.b + (x + 1) * f.a * f.a) * r, -2 * f.c * (f.b + (x + 1) * f.a) * r,
          f.c * (f.d + (x + 1) * f.c) * r};
}

/// p(y) by Horner's rule.
template <class Real, std::size_t terms>
constexpr Real value_of(const std::array<Real, terms>& p, Real y) {
  Real sum = p[terms - 1];
  for (std::size_t i = terms - 1; i-- > 0;) sum = sum * y + p[i];
  return sum;
}

// ---- exact errors of a single step, in pixels

/// x + 1 - F(step of f(x)).   [Cou, Eq. 3.7]
template <class Real>
constexpr Real euler1_step_error(Real c, Real d, Real x) {
  return -c / (c * (x - 1) + d);
}

/// The same for the second order: c²/(u² - cu + c²) with u = cx + d, that is 4c²/((2u - c)² + 3c²); [Cou,
/// Eq. 3.13] prints 3c²/4 where 3c² belongs.
template <class Real>
constexpr Real euler2_step_error(Real c, Real d, Real x) {
  const Real u = 2 * (c * x + d) - c;
  return 4 * c * c / (u * u + 3 * c * c);
}

/// x + 1 - F(Newton's step of f(x - h)): what a lag of h pixels becomes.   [Cou, Eq. 4.4]
template <class Real>
constexpr Real newton_step_error(Real c, Real d, Real x, Real h) {
  return -c * (h + 1) * (h + 1) / (c * x + d - 2 * h * c - c);
}

// ---- bounds of the progressive error after n steps: 0 <= e <= bound, in exact arithmetic

/// [Cou, Theorem 3.1]
template <class Real>
Real euler1_bound(Real c, Real d, Real n) {
  return -std::log1p(c * n / (d - c));
}

/// Below 2 for any span.   [Cou, Theorem 3.2]
template <class Real>
constexpr Real euler2_bound(Real c, Real d, Real n) {
  return 4 * c * c * n / ((2 * d - c + 2 * c * n) * (2 * d - c));
}

/// At most 1 for any span, and no larger after many steps than after few.   [Cou, Theorem 4.1]
template <class Real>
constexpr Real newton_bound(Real c, Real d, Real n) {
  const Real bound = -c / (c * n + d);
  return bound < 1 ? bound : Real(1);
}

// ---- the two programs of [Cou, section 6], operation by operation, as the yardstick of what they lose

/// Listing 1: numerators stepped by addition, times a reciprocal stepped by Newton. Fills y1 and y2 (equal
/// lengths) with two coordinates that share c and d; the second function's c and d are not read.
template <class Real>
void reciprocal_listing(const FractionalLinear<Real>& f1, const FractionalLinear<Real>& f2,
                        std::span<Real> y1, std::span<Real> y2) {
  Real n1 = f1.b, n2 = f2.b, q = -f1.d, y = 1 / f1.d;
  for (std::size_t x = 0; x < y1.size(); ++x) {
    y1[x] = n1 * y;
    y2[x] = n2 * y;
    n1 += f1.a;
    n2 += f2.a;
    q -= f1.c;
    y = (q * y + 2) * y;
  }
}

/// Listing 2: Newton's step on one coordinate, its three coefficients stepped by addition. D != 0.
template <class Real>
void general_listing(const FractionalLinear<Real>& f, std::span<Real> values) {
  const Real r = 1 / (f.a * f.d - f.b * f.c);
  Real y = f.b / f.d;
  Real q0 = f.a * f.b * r, q1 = -2 * f.b * f.c * r, q2 = f.c * f.d * r;
  const Real s0 = f.a * f.a * r, s1 = -2 * f.a * f.c * r, s2 = f.c * f.c * r;
  for (Real& value : values) {
    value = y;
    q0 += s0;
    q1 += s1;
    q2 += s2;
    y = (q2 * y + q1) * y + q0;
  }
}

} // namespace tilepack
