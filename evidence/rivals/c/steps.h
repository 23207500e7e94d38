/* The steps for one problem: included with NAME, D and UNIT_MASSES defined. */

static inline void NAME(kick)(const struct initial *s, double weight, const double *restrict q, double *restrict p)
{
    double g[D];
    NAME(gradient)(s, q, g);
    for (int d = 0; d < D; d++) p[d] -= weight * g[d];
}

static inline void NAME(drift)(const struct initial *s, double weight, double *restrict q, const double *restrict p)
{
    (void)s;
    for (int d = 0; d < D; d++) q[d] += UNIT_MASSES ? weight * p[d] : weight * s->inverse_mass[d] * p[d];
}

/* Störmer–Verlet as everybody writes it. */
static void NAME(verlet)(const struct initial *s, double h, long steps, double *state_q, double *state_p)
{
    double q[D], p[D];
    memcpy(q, state_q, sizeof q), memcpy(p, state_p, sizeof p);
    NAME(kick)(s, h / 2, q, p);
    for (long n = 1; n < steps; n++) {
        NAME(drift)(s, h, q, p);
        NAME(kick)(s, h, q, p);
    }
    NAME(drift)(s, h, q, p);
    NAME(kick)(s, h / 2, q, p);
    memcpy(state_q, q, sizeof q), memcpy(state_p, p, sizeof p);
}

/* Any scheme. */
static void NAME(scheme)(const struct initial *s, const struct plan *plan, long steps, double *state_q, double *state_p)
{
    double q[D], p[D], kick[MOST_MAPS], first_drift = plan->drift[0];
    int last = plan->stages - 1;
    memcpy(q, state_q, sizeof q), memcpy(p, state_p, sizeof p), memcpy(kick, plan->kick, sizeof kick);
    kick[last] += plan->opening;
    if (plan->opening != 0) NAME(kick)(s, plan->opening, q, p);
    for (long n = 1; n <= steps; n++) {
        if (n == steps) kick[last] = plan->kick[last];
        NAME(drift)(s, first_drift, q, p);
        NAME(kick)(s, kick[0], q, p);
        for (int i = 1; i <= last; i++) {
            NAME(drift)(s, plan->drift[i], q, p);
            NAME(kick)(s, kick[i], q, p);
        }
        first_drift = plan->drift[0] + plan->closing;
    }
    if (plan->closing != 0) NAME(drift)(s, plan->closing, q, p);
    memcpy(state_q, q, sizeof q), memcpy(state_p, p, sizeof p);
}

#undef NAME
#undef D
#undef UNIT_MASSES
