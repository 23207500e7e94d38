/* Steps of Störmer–Verlet one by one, for one problem: included with NAME, D and UNIT_MASSES defined, which `steps.h` ends. */

static void NAME(steps)(const struct initial *s, double h, long steps, double *state_q, double *state_p)
{
    double q[D], p[D], g[D];
    memcpy(q, state_q, sizeof q), memcpy(p, state_p, sizeof p);
    NAME(gradient)(s, q, g);
    for (long n = 0; n < steps; n++) {
        for (int d = 0; d < D; d++) p[d] -= h / 2 * g[d];
        for (int d = 0; d < D; d++) q[d] += UNIT_MASSES ? h * p[d] : h * s->inverse_mass[d] * p[d];
        NAME(gradient)(s, q, g);
        for (int d = 0; d < D; d++) p[d] -= h / 2 * g[d];
    }
    memcpy(state_q, q, sizeof q), memcpy(state_p, p, sizeof p);
}

/* The same with increments: what the newest steps added to beta, q and p, 16 in turn. */
static void NAME(augmented)(const struct initial *s, double h, long steps, double *state_q, double *state_p, double *newest)
{
    double q[D], p[D], g[D];
    memcpy(q, state_q, sizeof q), memcpy(p, state_p, sizeof p);
    double rate = NAME(gradient_and_rate)(s, q, g);
    for (long n = 0; n < steps; n++) {
        double *beta = newest + n % 16 * (2 * D + 1), *dq = beta + 1, *dp = dq + D;
        *beta = h / 2 * rate;
        for (int d = 0; d < D; d++) {
            double kick = h / 2 * g[d];
            p[d] -= kick, dp[d] = -kick;
        }
        for (int d = 0; d < D; d++) {
            double drift = UNIT_MASSES ? h * p[d] : h * s->inverse_mass[d] * p[d];
            q[d] += drift, dq[d] = drift;
        }
        rate = NAME(gradient_and_rate)(s, q, g);
        *beta += h / 2 * rate;
        for (int d = 0; d < D; d++) {
            double kick = h / 2 * g[d];
            p[d] -= kick, dp[d] -= kick;
        }
    }
    memcpy(state_q, q, sizeof q), memcpy(state_p, p, sizeof p);
}
