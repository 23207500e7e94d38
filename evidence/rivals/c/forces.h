/* The gradients of the potentials, written by hand for each problem. For C and C++. */
#ifndef FORCES_H
#define FORCES_H

#include <math.h>

#include "protocol.h"

enum { KEPLER_D = 2, HENON_HEILES_D = 2, OUTER_D = 18, FPUT_D = 32, ARGON_D = 1500 };

static inline void kepler_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    (void)s;
    double r2 = q[0] * q[0] + q[1] * q[1];
    double inverse_cube = 1 / (r2 * sqrt(r2));
    g[0] = q[0] * inverse_cube;
    g[1] = q[1] * inverse_cube;
}

static inline void henon_heiles_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    (void)s;
    g[0] = q[0] + 2 * q[0] * q[1];
    g[1] = q[1] + q[0] * q[0] - q[1] * q[1];
}

/* Returns q U_q - 2 U, too. */
static inline double outer_gradient_and_rate(const struct initial *s, const double *restrict q, double *restrict g)
{
    double sum = 0;
    for (int i = 0; i < OUTER_D; i++) g[i] = 0;
    for (int i = 0; i < 6; i++)
        for (int j = i + 1; j < 6; j++) {
            double x = q[3 * j] - q[3 * i], y = q[3 * j + 1] - q[3 * i + 1], z = q[3 * j + 2] - q[3 * i + 2];
            double r2 = x * x + y * y + z * z;
            double slope = s->parameters[0] * s->mass[3 * i] * s->mass[3 * j] / (r2 * sqrt(r2));
            sum += slope * r2;
            g[3 * i] -= slope * x, g[3 * i + 1] -= slope * y, g[3 * i + 2] -= slope * z;
            g[3 * j] += slope * x, g[3 * j + 1] += slope * y, g[3 * j + 2] += slope * z;
        }
    return 3 * sum;
}

static inline void outer_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    outer_gradient_and_rate(s, q, g);
}

static inline void fput_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    double alpha = s->parameters[0], left = q[0] + alpha * q[0] * q[0];
    for (int i = 0; i < FPUT_D; i++) {
        double d = (i + 1 < FPUT_D ? q[i + 1] : 0) - q[i], right = d + alpha * d * d;
        g[i] = left - right;
        left = right;
    }
}

/* The atoms' coordinates are copied into three arrays, so that the compiler can use vector instructions. */
static inline void argon_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    enum { ATOMS = ARGON_D / 3 };
    static double x[ATOMS], y[ATOMS], z[ATOMS], gx[ATOMS], gy[ATOMS], gz[ATOMS];
    double epsilon = s->parameters[0], sigma2 = s->parameters[1] * s->parameters[1];
    for (int i = 0; i < ATOMS; i++) {
        x[i] = q[3 * i], y[i] = q[3 * i + 1], z[i] = q[3 * i + 2];
        gx[i] = gy[i] = gz[i] = 0;
    }
    for (int i = 0; i < ATOMS; i++) {
        double sum_x = 0, sum_y = 0, sum_z = 0;
        for (int j = i + 1; j < ATOMS; j++) {
            double dx = x[j] - x[i], dy = y[j] - y[i], dz = z[j] - z[i];
            double inverse = 1 / (dx * dx + dy * dy + dz * dz), s2 = sigma2 * inverse, s6 = s2 * s2 * s2;
            double slope = 24 * epsilon * (s6 - 2 * s6 * s6) * inverse;
            gx[j] += slope * dx, gy[j] += slope * dy, gz[j] += slope * dz;
            sum_x += slope * dx, sum_y += slope * dy, sum_z += slope * dz;
        }
        gx[i] -= sum_x, gy[i] -= sum_y, gz[i] -= sum_z;
    }
    for (int i = 0; i < ATOMS; i++) g[3 * i] = gx[i], g[3 * i + 1] = gy[i], g[3 * i + 2] = gz[i];
}

#endif
