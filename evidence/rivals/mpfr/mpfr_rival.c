/* Kepler's problem at 120 digits with MPFR in C, as one writes it for a paper: compositions of Störmer–Verlet, in place,
   with the kicks of neighbouring steps merged and all variables allocated once. */
#include <mpfr.h>

#include "../c/protocol.h"

#define BITS 400 /* 120 digits and one bit, as Shadowstep has them */
#define MOST_SUBSTEPS 3

static mpfr_t q[2], p[2], r2, cube, inverse, product;

static void kick(mpfr_t weight)
{
    mpfr_sqr(r2, q[0], MPFR_RNDN);
    mpfr_fma(r2, q[1], q[1], r2, MPFR_RNDN);
    mpfr_rec_sqrt(inverse, r2, MPFR_RNDN);
    mpfr_sqr(cube, inverse, MPFR_RNDN);
    mpfr_mul(cube, cube, inverse, MPFR_RNDN);
    mpfr_mul(cube, cube, weight, MPFR_RNDN);
    for (int d = 0; d < 2; d++) {
        mpfr_mul(product, cube, q[d], MPFR_RNDN);
        mpfr_sub(p[d], p[d], product, MPFR_RNDN);
    }
}

static void drift(mpfr_t weight)
{
    for (int d = 0; d < 2; d++) {
        mpfr_mul(product, weight, p[d], MPFR_RNDN);
        mpfr_add(q[d], q[d], product, MPFR_RNDN);
    }
}

/* The substeps h·γ: one for Störmer–Verlet, three for Yoshida's scheme of order 4. */
static int substeps(const char *method, double until, long steps, mpfr_t gamma[])
{
    mpfr_t h;
    mpfr_init2(h, BITS);
    mpfr_set_d(h, until, MPFR_RNDN);
    mpfr_div_si(h, h, steps, MPFR_RNDN);
    int count = strcmp(method, "yoshida4") == 0 ? 3 : 1;
    mpfr_set(gamma[0], h, MPFR_RNDN);
    if (count == 3) {
        mpfr_set_ui(product, 2, MPFR_RNDN);
        mpfr_rootn_ui(product, product, 3, MPFR_RNDN);
        mpfr_ui_sub(product, 2, product, MPFR_RNDN);
        mpfr_div(gamma[0], h, product, MPFR_RNDN);
        mpfr_mul_ui(gamma[1], gamma[0], 2, MPFR_RNDN);
        mpfr_sub(gamma[1], h, gamma[1], MPFR_RNDN);
        mpfr_set(gamma[2], gamma[0], MPFR_RNDN);
    }
    mpfr_clear(h);
    return count;
}

static void integrate(int count, mpfr_t gamma[], mpfr_t kicks[], mpfr_t half, long steps)
{
    kick(half);
    for (long n = 1; n <= steps; n++)
        for (int i = 0; i < count; i++) {
            drift(gamma[i]);
            kick(n == steps && i == count - 1 ? half : kicks[i]);
        }
}

int main(void)
{
    static struct initial s;
    struct request r;
    mpfr_t gamma[MOST_SUBSTEPS], kicks[MOST_SUBSTEPS], half;
    for (int i = 0; i < MOST_SUBSTEPS; i++) mpfr_inits2(BITS, gamma[i], kicks[i], (mpfr_ptr)0);
    mpfr_inits2(BITS, q[0], q[1], p[0], p[1], r2, cube, inverse, product, half, (mpfr_ptr)0);
    while (next_request(&r)) {
        read_initial("kepler", &s);
        for (int d = 0; d < 2; d++) mpfr_set_d(q[d], s.q[d], MPFR_RNDN), mpfr_set_d(p[d], s.p[d], MPFR_RNDN);
        long steps = atol(r.parameter);
        int count = substeps(r.method, r.until, steps, gamma);
        for (int i = 0; i < count; i++) {
            mpfr_add(kicks[i], gamma[i], gamma[(i + 1) % count], MPFR_RNDN);
            mpfr_div_2ui(kicks[i], kicks[i], 1, MPFR_RNDN);
        }
        mpfr_div_2ui(half, gamma[0], 1, MPFR_RNDN);
        double time = 0;
        for (int sample = 0; sample < r.samples; sample++) {
            double start = seconds();
            integrate(count, gamma, kicks, half, steps / r.samples);
            time += seconds() - start;
            double ends[4] = {mpfr_get_d(q[0], MPFR_RNDN), mpfr_get_d(q[1], MPFR_RNDN), mpfr_get_d(p[0], MPFR_RNDN),
                              mpfr_get_d(p[1], MPFR_RNDN)};
            report_state(2, ends, ends + 2);
        }
        print_answer(time);
    }
}
