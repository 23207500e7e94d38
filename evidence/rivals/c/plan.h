/* A step between its merged ends: `opening` kick, then drift[i] and kick[i] in turn, then `closing` drift. */
#ifndef PLAN_H
#define PLAN_H

#define MOST_MAPS 100

struct plan {
    int stages;
    double opening, drift[MOST_MAPS], kick[MOST_MAPS], closing;
};

#endif
