‹provenance›
//
// Steps of q' = T_p(p), p' = -U_q(q), where H = T(p) + U(q).
// A step costs ‹cost›.
//
//     SCHEME_system system = {.n = n, .gradient = gradient};
//     SCHEME_integrate(&system, h, steps, q, p, work); // work: ‹IDENTIFIER›_WORK * n numbers
//
// This file has its own test: cc -DSELF_TEST -O2 -ffp-contract=off -x c ‹identifier›.h -lm && ./a.out
// If the compiler may fuse products with sums (-ffp-contract), results differ by round-off.
#ifndef SHADOWSTEP_‹IDENTIFIER›_H
#define SHADOWSTEP_‹IDENTIFIER›_H

#include <stddef.h>

‹weights›

// A system of n degrees of freedom.
typedef struct {
    size_t n;
    // gradient = U_q(q)
    void (*gradient)(size_t n, const double *q, double *gradient, void *context);
‹if every_kinetic›
    // velocity = T_p(p); null for unit masses
‹end›
‹if not every_kinetic›
    // velocity = p/m, as the order is for quadratic T only; null for unit masses
‹end›
    void (*velocity)(size_t n, const double *p, double *velocity, void *context);
‹if gradient_kicks›
    // product = U_qq(q) v
    void (*hessian_product)(size_t n, const double *q, const double *v, double *product, void *context);
‹end›
    void *context;
} SCHEME_system;

‹if kept›
// How many arrays of n numbers the work space has. Between steps it keeps derivatives of U at q, for the
// next step: each trajectory has its own.
‹end›
‹if not kept›
// How many arrays of n numbers the work space has.
‹end›
enum { ‹IDENTIFIER›_WORK = ‹arrays› };

static inline void SCHEME_kick(const SCHEME_system *s, double weight, const double *g, double *p)
{
    for (size_t i = 0; i < s->n; i++) p[i] -= weight * g[i];
}

static inline void SCHEME_drift(const SCHEME_system *s, double weight, const double *p, double *v, double *q)
{
    if (s->velocity) s->velocity(s->n, p, v, s->context), p = v;
    for (size_t i = 0; i < s->n; i++) q[i] += weight * p[i];
}

‹if gradient_kicks›
// w = U_qq(q) v with the velocity v that g has in the place of p.
static inline void SCHEME_curvature(const SCHEME_system *s, const double *q, const double *g, double *v, double *w)
{
    if (s->velocity) s->velocity(s->n, g, v, s->context), g = v;
    s->hessian_product(s->n, q, g, w, s->context);
}

‹end›
‹if processed›
// The pre-map: the state at which the steps begin, from that of the trajectory.
static inline void SCHEME_pre(const SCHEME_system *s, double h, double *q, double *p, double *work)
{
    double *g = work, *v = work + s->n;
    ‹pre›
}

// The post-map: the state of the trajectory, from that which steps have reached. To go on with these,
// give it a copy of q and p, and work space of its own.
static inline void SCHEME_post(const SCHEME_system *s, double h, double *q, double *p, double *work)
{
    double *g = work, *v = work + s->n;
    ‹post›
}

‹end›
‹if kept›
// Before the first step, and whenever q was changed by others.
static inline void SCHEME_begin(const SCHEME_system *s, const double *q, double *work)
{
‹if kept_gradient›
    s->gradient(s->n, q, work, s->context);
‹end›
‹if kept_curvature›
    double *g = work, *v = work + s->n, *w = work + 2 * s->n;
    s->gradient(s->n, q, g, s->context);
    SCHEME_curvature(s, q, g, v, w);
‹end›
}

‹end›
// One step of size h.
static inline void SCHEME_step(const SCHEME_system *s, double h, double *q, double *p, double *work)
{
‹if not gradient_kicks›
    double *g = work, *v = work + s->n;
‹end›
‹if gradient_kicks›
    double *g = work, *v = work + s->n, *w = work + 2 * s->n;
‹end›
    ‹step›
}

// This number of steps of size h.
static inline void SCHEME_integrate(const SCHEME_system *s, double h, long steps, double *q, double *p, double *work)
{
‹if processed›
    SCHEME_pre(s, h, q, p, work);
‹end›
‹if kept›
    SCHEME_begin(s, q, work);
‹end›
    while (steps-- > 0) SCHEME_step(s, h, q, p, work);
‹if processed›
    SCHEME_post(s, h, q, p, work);
‹end›
}

#ifdef SELF_TEST
// Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order.
#include <math.h>
#include <stdio.h>

static void kepler_gradient(size_t n, const double *q, double *gradient, void *context)
{
    double r2 = q[0] * q[0] + q[1] * q[1], r3 = r2 * sqrt(r2);
    for (size_t i = 0; i < n; i++) gradient[i] = q[i] / r3;
    (void)context;
}

‹if gradient_kicks›
static void kepler_hessian_product(size_t n, const double *q, const double *v, double *product, void *context)
{
    double r2 = q[0] * q[0] + q[1] * q[1], r3 = r2 * sqrt(r2), s = 3 * (q[0] * v[0] + q[1] * v[1]) / r2;
    for (size_t i = 0; i < n; i++) product[i] = (v[i] - s * q[i]) / r3;
    (void)context;
}

‹end›
static double error(double h, long steps, const double *expected)
{
‹if not gradient_kicks›
    SCHEME_system kepler = {.n = 2, .gradient = kepler_gradient};
‹end›
‹if gradient_kicks›
    SCHEME_system kepler = {.n = 2, .gradient = kepler_gradient, .hessian_product = kepler_hessian_product};
‹end›
    double q[] = {0.4, 0.0}, p[] = {0.0, 2.0}, work[2 * ‹IDENTIFIER›_WORK], largest = 0;
    SCHEME_integrate(&kepler, h, steps, q, p, work);
    for (int i = 0; i < 2; i++) {
        largest = fmax(largest, fabs(q[i] - expected[i]));
        largest = fmax(largest, fabs(p[i] - expected[2 + i]));
    }
    return largest;
}

int main(void)
{
    const double end[] = {‹end_q›, ‹end_p›};
    double distance = error(‹h›, ‹count›, end);
    printf("‹name›: ‹count› steps of ‹part›: ");
    if (distance == 0) puts("the bits of Shadowstep");
    else printf("%.1e from Shadowstep\n", distance);
    int passed = distance < ‹tolerance›;
‹if order_shows›

    const double exact[] = {‹exact_q›, ‹exact_p›}; // at t = ‹time›
    double order = log2(error(‹time›.0 / ‹coarse›, ‹coarse›, exact) / error(‹time›.0 / ‹fine›, ‹fine›, exact));
    printf("‹name›: order %.2f observed, ‹order› proved\n", order);
    passed = passed && order > ‹order› - 0.5;
‹end›
    if (!passed) puts("‹name›: the self-test has failed");
    return !passed;
}
#endif

#endif
