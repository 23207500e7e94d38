/* Splitting schemes written by hand in C: the last kick (or drift) of a step and the first one of the next are one. */
#include "forces.h"
#include "plan.h"

/* Reads the maps that `ours weights` has printed into the folder of the environment variable SCHEMES. */
static void read_plan(const char *scheme, double h, struct plan *plan)
{
    char path[4096], kind[8];
    double weight;
    snprintf(path, sizeof path, "%s/%s.txt", getenv("SCHEMES"), scheme);
    FILE *file = fopen(path, "r");
    if (!file) fail("cannot be read", path);
    memset(plan, 0, sizeof *plan);
    while (fscanf(file, "%7s %lf", kind, &weight) == 2) {
        if (strcmp(kind, "drift") == 0) plan->drift[plan->stages++] = h * weight;
        else if (plan->stages == 0) plan->opening = h * weight;
        else plan->kick[plan->stages - 1] = h * weight;
    }
    fclose(file);
    if (plan->opening == 0) plan->closing = plan->drift[--plan->stages]; /* drifts at both ends */
}

/* the steps for each problem */
#define NAME(part) kepler_##part
#define D KEPLER_D
#define UNIT_MASSES 1
#include "steps.h"

#define NAME(part) henon_heiles_##part
#define D HENON_HEILES_D
#define UNIT_MASSES 1
#include "steps.h"

#define NAME(part) outer_##part
#define D OUTER_D
#define UNIT_MASSES 0
#include "steps.h"

#define NAME(part) fput_##part
#define D FPUT_D
#define UNIT_MASSES 1
#include "steps.h"

#define NAME(part) argon_##part
#define D ARGON_D
#define UNIT_MASSES 0
#include "steps.h"

static const struct {
    const char *problem;
    void (*verlet)(const struct initial *, double, long, double *, double *);
    void (*scheme)(const struct initial *, const struct plan *, long, double *, double *);
} PROBLEMS[] = {
    {"kepler", kepler_verlet, kepler_scheme},
    {"henon-heiles", henon_heiles_verlet, henon_heiles_scheme},
    {"outer-solar-system", outer_verlet, outer_scheme},
    {"fput-alpha", fput_verlet, fput_scheme},
    {"argon", argon_verlet, argon_scheme},
};

int main(void)
{
    static struct initial s;
    static struct plan plan;
    struct request r;
    while (next_request(&r)) {
        size_t i = 0;
        while (strcmp(PROBLEMS[i].problem, r.problem) != 0)
            if (++i == sizeof PROBLEMS / sizeof PROBLEMS[0]) fail("no such problem", r.problem);
        read_initial(r.problem, &s);
        long steps = atol(r.parameter);
        double h = r.until / steps, time = 0;
        read_plan(r.method, h, &plan);
        int verlet = strcmp(r.method, "stormer-verlet") == 0;
        for (int sample = 0; sample < r.samples; sample++) {
            double start = seconds();
            if (verlet) PROBLEMS[i].verlet(&s, h, steps / r.samples, s.q, s.p);
            else PROBLEMS[i].scheme(&s, &plan, steps / r.samples, s.q, s.p);
            time += seconds() - start;
            report_state(s.dimension, s.q, s.p);
        }
        print_answer(time);
    }
}
