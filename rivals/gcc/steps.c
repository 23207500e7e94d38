/* The steps of ../c, to be called in one process with those of Shadowstep. */
#include "../c/forces.h"
#include "../c/plan.h"

enum { PENDULUM_D = 1 };

static inline void pendulum_gradient(const struct initial *s, const double *restrict q, double *restrict g)
{
    (void)s;
    g[0] = sin(q[0]);
}

#define NAME(part) kepler_##part
#define D KEPLER_D
#define UNIT_MASSES 1
#include "../c/steps.h"

#define NAME(part) henon_heiles_##part
#define D HENON_HEILES_D
#define UNIT_MASSES 1
#include "../c/steps.h"

#define NAME(part) outer_##part
#define D OUTER_D
#define UNIT_MASSES 0
#include "../c/steps.h"

#define NAME(part) pendulum_##part
#define D PENDULUM_D
#define UNIT_MASSES 1
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
