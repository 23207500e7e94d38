/* Preloaded into the program: makes calls that change files fail, or kills the program at one of them, or makes clocks jump.
 *
 * FAULT_KILL=n     the program is killed at the n-th such call; of a write, half is written before
 * FAULT_SIGNAL=s   it gets the signal s just after that call instead
 * FAULT_ERRNO=e    from call number FAULT_FROM on, calls that need room or a folder fail with this error
 * FAULT_CLOCK=s    clocks jump, as chosen by the seed s: that of the day forth and back, the monotonic one forth
 * FAULT_COUNT=FILE the number of such calls is written there at the end
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

static atomic_long calls;
static atomic_ulong draws;

static long setting(const char *name) {
    const char *text = getenv(name);
    return text ? atol(text) : -1;
}

#define REAL(type, name, ...) ((type (*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

static void die(void) {
    kill(getpid(), SIGKILL);
    for (;;) pause();
}

/* The number of the call that this one is. */
static _Thread_local long call;

/* Whether this call is the one to die in; sets *fails where it must fail. */
static int is_last(int *fails) {
    long from = setting("FAULT_FROM");
    call = ++calls;
    *fails = setting("FAULT_ERRNO") > 0 && call >= (from < 0 ? 1 : from);
    if (*fails) errno = (int)setting("FAULT_ERRNO");
    return call == setting("FAULT_KILL") && setting("FAULT_SIGNAL") < 0;
}

/* The result of a call, after which there may be a signal. */
static long after(long result) {
    int error = errno;
    if (call == setting("FAULT_KILL") && setting("FAULT_SIGNAL") > 0) kill(getpid(), (int)setting("FAULT_SIGNAL"));
    errno = error;
    return result;
}

__attribute__((destructor)) static void count(void) {
    const char *path = getenv("FAULT_COUNT");
    FILE *file = path ? fopen(path, "w") : NULL;
    if (file) {
        fprintf(file, "%ld", (long)calls);
        fclose(file);
    }
}

ssize_t write(int fd, const void *bytes, size_t length) {
    ssize_t (*real)(int, const void *, size_t) = REAL(ssize_t, "write", int, const void *, size_t);
    int fails;
    if (fd <= 2) return real(fd, bytes, length);
    if (is_last(&fails)) {
        real(fd, bytes, length / 2);
        die();
    }
    return fails ? -1 : after(real(fd, bytes, length));
}

int open64(const char *path, int flags, ...) {
    int (*real)(const char *, int, ...) = REAL(int, "open64", const char *, int, ...);
    va_list rest;
    va_start(rest, flags);
    mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    int fails = 0;
    if ((flags & O_CREAT) && is_last(&fails)) die();
    if (fails) return -1;
    return flags & O_CREAT ? (int)after(real(path, flags, mode)) : real(path, flags, mode);
}

int rename(const char *from, const char *to) {
    int fails;
    if (is_last(&fails)) die();
    return fails ? -1 : (int)after(REAL(int, "rename", const char *, const char *)(from, to));
}

int mkdir(const char *path, mode_t mode) {
    int fails;
    if (is_last(&fails)) die();
    return fails ? -1 : (int)after(REAL(int, "mkdir", const char *, mode_t)(path, mode));
}

/* These need no room. */
int unlink(const char *path) {
    int fails;
    if (is_last(&fails)) die();
    return (int)after(REAL(int, "unlink", const char *)(path));
}

int ftruncate64(int fd, off_t length) {
    int fails;
    if (is_last(&fails)) die();
    return (int)after(REAL(int, "ftruncate64", int, off_t)(fd, length));
}

/* splitmix64 */
static unsigned long draw(unsigned long seed) {
    unsigned long z = seed + 0x9e3779b97f4a7c15ul * ++draws;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ul;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebul;
    return z ^ (z >> 31);
}

int clock_gettime(clockid_t clock, struct timespec *now) {
    static atomic_long ahead;
    int result = REAL(int, "clock_gettime", clockid_t, struct timespec *)(clock, now);
    long seed = setting("FAULT_CLOCK");
    if (seed < 0) return result;
    unsigned long drawn = draw((unsigned long)seed);
    if (clock == CLOCK_REALTIME) {
        /* up to ten years forth or back */
        now->tv_sec += (long)(drawn % 630720000ul) - 315360000l;
    } else {
        /* now and then some minutes forth, as after a pause of the machine */
        if (drawn % 16 == 0) ahead += (long)(drawn / 16 % 600);
        now->tv_sec += ahead;
    }
    return result;
}
