/* Requests and answers as rust/src/protocol.rs describes them, and the initial states that `ours initial` has printed.
   For C and C++. */
#ifndef PROTOCOL_H
#define PROTOCOL_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LARGEST_DIMENSION 1500

struct request {
    char problem[40], method[40], parameter[40];
    int samples;
    double until;
};

struct initial {
    int dimension;
    double parameters[4];
    double mass[LARGEST_DIMENSION], inverse_mass[LARGEST_DIMENSION];
    double q[LARGEST_DIMENSION], p[LARGEST_DIMENSION];
};

static int next_request(struct request *r)
{
    return scanf("%39s %39s %39s %d %lf", r->problem, r->method, r->parameter, &r->samples, &r->until) == 5;
}

/* Of the processor, so that other programs on the machine do not count. */
static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

static void fail(const char *what, const char *which)
{
    fprintf(stderr, "%s: %s\n", what, which);
    exit(1);
}

static int read_numbers(FILE *file, double *numbers)
{
    int count = 0;
    if (fscanf(file, "%d", &count) != 1) fail("not a number", "count");
    for (int i = 0; i < count; i++)
        if (fscanf(file, "%lf", &numbers[i]) != 1) fail("not a number", "initial state");
    return count;
}

/* The files are in the folder of the environment variable INITIAL. */
static void read_initial(const char *problem, struct initial *initial)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.txt", getenv("INITIAL"), problem);
    FILE *file = fopen(path, "r");
    if (!file) fail("cannot be read", path);
    read_numbers(file, initial->parameters);
    initial->dimension = read_numbers(file, initial->mass);
    read_numbers(file, initial->q);
    read_numbers(file, initial->p);
    fclose(file);
    for (int i = 0; i < initial->dimension; i++) initial->inverse_mass[i] = 1 / initial->mass[i];
}

/* An answer: the time, then each state. States are kept until the end, as the time comes first. */
static char *states;
static size_t states_length, states_size;

static void report_state(int dimension, const double *q, const double *p)
{
    size_t needed = states_length + 2 * (size_t)dimension * 26 + 1;
    if (needed > states_size) states = (char *)realloc(states, states_size = 2 * needed);
    for (int i = 0; i < 2 * dimension; i++)
        states_length += (size_t)sprintf(states + states_length, " %.17g", i < dimension ? q[i] : p[i - dimension]);
}

static void print_answer(double time)
{
    printf("%.9e%s\n", time, states_length ? states : "");
    fflush(stdout);
    states_length = 0;
}

#endif
