/* The steps of ../c, to be called in one process with those of Shadowstep. */
#include "../c/forces.h"
#include "../c/plan.h"

enum { PENDULUM_D = 1 };

static inline void pendulum_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    (void)s;
    g[0] = sin(q[0]);
}

/* The gradient, and q U_q - 2 U, which beta is carried by. */

static inline double kepler_gradient_and_rate(const struct initial *s, const double *restrict q, double *restrict g)
{
    (void)s;
    double r2 = q[0] * q[0] + q[1] * q[1], r = sqrt(r2), inverse_cube = 1 / (r2 * r);
    g[0] = q[0] * inverse_cube;
    g[1] = q[1] * inverse_cube;
    return 3 * r2 * inverse_cube;
}

static inline double henon_heiles_gradient_and_rate(const struct initial *s, const double *restrict q, double *restrict g)
{
    henon_heiles_gradient(s, q, g);
    return (q[0] * q[0] - q[1] * q[1] / 3) * q[1];
}

static inline double pendulum_gradient_and_rate(const struct initial *s, const double *restrict q, double *restrict g)
{
    (void)s;
    g[0] = sin(q[0]);
    return q[0] * g[0] + 2 * cos(q[0]);
}

#define NAME(part) kepler_##part
#define D KEPLER_D
#define UNIT_MASSES 1
#include "augmented.h"
#include "../c/steps.h"

#define NAME(part) henon_heiles_##part
#define D HENON_HEILES_D
#define UNIT_MASSES 1
#include "augmented.h"
#include "../c/steps.h"

#define NAME(part) outer_##part
#define D OUTER_D
#define UNIT_MASSES 0
#include "augmented.h"
#include "../c/steps.h"

#define NAME(part) pendulum_##part
#define D PENDULUM_D
#define UNIT_MASSES 1
#include "augmented.h"
#include "../c/steps.h"

static struct initial initial;

/* Parameters and masses, one for each coordinate. */
void set_initial(int dimension, const double *masses, int parameters, const double *values)
{
    initial.dimension = dimension;
    memcpy(initial.parameters, values, parameters * sizeof *values);
    memcpy(initial.mass, masses, dimension * sizeof *masses);
    for (int i = 0; i < dimension; i++) initial.inverse_mass[i] = 1 / masses[i];
}

/* Störmer–Verlet, the kicks at the ends of neighbouring steps in one. */
void verlet(int problem, double h, long steps, double *q, double *p)
{
    switch (problem) {
    case 0: kepler_verlet(&initial, h, steps, q, p); break;
    case 1: henon_heiles_verlet(&initial, h, steps, q, p); break;
    case 2: outer_verlet(&initial, h, steps, q, p); break;
    case 3: pendulum_verlet(&initial, h, steps, q, p); break;
    }
}

/* A scheme that begins and ends with a kick, its ends merged: opening kick, then drifts and kicks in turn. */
void scheme(int problem, int stages, double opening, const double *drifts, const double *kicks, long steps, double *q, double *p)
{
    struct plan plan = {.stages = stages, .opening = opening};
    memcpy(plan.drift, drifts, stages * sizeof *drifts);
    memcpy(plan.kick, kicks, stages * sizeof *kicks);
    switch (problem) {
    case 0: kepler_scheme(&initial, &plan, steps, q, p); break;
    case 1: henon_heiles_scheme(&initial, &plan, steps, q, p); break;
    case 2: outer_scheme(&initial, &plan, steps, q, p); break;
    case 3: pendulum_scheme(&initial, &plan, steps, q, p); break;
    }
}

/* Störmer–Verlet, one step after the other; with increments where there is room for the newest 16. */
void one_by_one(int problem, double h, long steps, double *q, double *p, double *newest)
{
    switch (2 * problem + (newest != NULL)) {
    case 0: kepler_steps(&initial, h, steps, q, p); break;
    case 1: kepler_augmented(&initial, h, steps, q, p, newest); break;
    case 2: henon_heiles_steps(&initial, h, steps, q, p); break;
    case 3: henon_heiles_augmented(&initial, h, steps, q, p, newest); break;
    case 4: outer_steps(&initial, h, steps, q, p); break;
    case 5: outer_augmented(&initial, h, steps, q, p, newest); break;
    case 6: pendulum_steps(&initial, h, steps, q, p); break;
    case 7: pendulum_augmented(&initial, h, steps, q, p, newest); break;
    }
}
