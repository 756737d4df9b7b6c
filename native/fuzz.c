/* libFuzzer over the emitted kernel, built with the sanitizers: see .ci/kernel.

   The first byte chooses: a robot driven over terrain, whose poses have to be finite; or any entry with
   any numbers in its tables, which may be refused and nothing else. */
#define POISON
#define MOST_BYTES ((int64_t)1 << 24)
#include "calls.h"
#include <stdio.h>

enum { MOST_ROWS = 40, POSES = 120 };
static const uint8_t *bytes;
static size_t left;

static uint8_t byte(void) { return left ? (left--, *bytes++) : 0; }

static double between(double low, double high) {
    return low + (high - low) * ((byte() << 8 | byte()) / 65535.0);
}

static int run(void (*entry)(void *), void *given) {
    begin();
    int fails = SETJMP(now.door);
    if (!fails) entry(given);
    end();
    return fails;
}

/* --- a robot driven over terrain */

static int terrain(Point *ground) {
    int count = 3 + byte() % (MOST_ROWS - 3);
    double x = -3.0, z = 0.0;
    for (int k = 0; k < count; k++) {
        ground[k] = (Point){.x = x, .z = z};
        int vertical = byte() & 1 && k && k < count - 2;
        x += k && k < count - 2 ? (vertical ? 0.0 : between(0.002, 0.5)) : 3.0;
        if (k && k < count - 2) z += vertical ? between(0.002, 0.4) : between(-0.2, 0.2);
    }
    for (int k = 0; k < count; k++) {
        Point *one = &ground[k], *then = &ground[k + 1 < count ? k + 1 : k];
        double d_x = then->x - one->x, d_z = then->z - one->z, length = sqrt(d_x * d_x + d_z * d_z);
        if (k + 1 < count) one->u_x = d_x / length, one->u_z = d_z / length, one->length = length;
        else one->u_x = ground[k - 1].u_x, one->u_z = ground[k - 1].u_z;
        if (k) one->convex = ground[k - 1].u_x * one->u_z - ground[k - 1].u_z * one->u_x < 0.0;
    }
    return count;
}

static Part part(double x, double z, double r, double far, double lean, double to, int64_t kind) {
    Disc one = {x, z, r}, two = {x + far * cos(lean), z + far * sin(lean), to};
    double e_x = (two.x - one.x) / far, e_z = (two.z - one.z) / far, sine = (r - to) / far;
    double cosine = sqrt(1.0 - sine * sine);
    return (Part){one, two, e_x, e_z, far, sine, cosine, far * cosine, e_x >= 0.0 ? 1.0 : -1.0, kind};
}

static void drive(void) {
    static Point ground[MOST_ROWS];
    static Part body[4];
    static Pose poses[POSES];
    static EventRow events[POSES];
    static RotationRow rotations[POSES / 8 + 16];
    static Margin margins[POSES];
    int64_t points = terrain(ground), parts = 1 + byte() % 3, rows[POSES];
    for (int k = 0; k < parts; k++) {
        double r = between(0.002, 0.15), to = between(0.002, 0.15);
        double far = fabs(r - to) + between(0.05, 0.8);
        body[k] = part(between(-0.4, 0.3), between(-0.15, 0.1), r, far, between(-3.1, 3.1), to,
                       k ? byte() % 3 : 0);
    }
    Call_driver_drive call = {
        .scene = {{ground, points}, {body, parts}, 0},
        .journey = {between(-1.0, 0.5), between(0.6, 3.0), between(-0.5, 0.5), between(0.01, 0.08),
                    between(0.05, 0.4)},
        .pull = {between(-1.0, 1.0) * (byte() & 1), 9.8, between(-0.3, 0.3) * (byte() & 1)},
        .log = {{poses, POSES}, {events, POSES}, {rotations, POSES / 8 + 16}, true, 0, 0, 0, 0.0, 0},
    };
    if (run(run_driver_drive, &call)) {
        fprintf(stderr, "%s:%d: row %lld of %lld\n", now.file, now.line, (long long)now.index,
                (long long)now.count);
        abort();
    }
    int64_t count = call.answer._1;
    for (int64_t k = 0; k < count; k++) {
        Pose *at = &poses[k];
        rows[k] = k;
        if (!isfinite(at->x + at->z + at->inclination + at->s + at->rear.x + at->front.x)) abort();
    }
    Call_margins_pose_margins told = {
        .scene = {{ground, points}, {body, parts}, 0}, .poses = {poses, count}, .pull = call.pull,
        .margins = {margins, count},
    };
    if (run(run_margins_pose_margins, &told)) abort();
    Call_energy_margins_flow_energy energy = {
        .scene = told.scene, .poses = told.poses, .margins = told.margins, .rows = {rows, count},
    };
    if (run(run_energy_margins_flow_energy, &energy)) abort();
}

/* --- any entry, any numbers */

static double number(void) {
    static const double odd[] = {0.0, -0.0, 1.0, -1.0, 1e-9, 1e9, 1e300, INFINITY, -INFINITY, NAN};
    uint8_t kind = byte();
    if (kind < sizeof(odd) / sizeof(*odd)) return odd[kind];
    return kind & 1 ? between(-1.0, 1.0) : between(-40.0, 40.0);
}

static int64_t whole_number(void) {
    uint8_t kind = byte();
    if (kind == 0) return (int64_t)1 << (byte() & 63);
    if (kind < 16) return -(int64_t)byte();
    return kind < 200 ? kind & 7 : byte() << 6 | (byte() & 63);
}

static void fill(char kind, int of, char *at) {
    if (kind == 'b') *(bool *)at = byte() & 1;
    else if (kind == 'd') *(double *)at = number();
    else if (kind == 'T') {
        int64_t count = byte() % MOST_ROWS;
        *(void **)at = calloc((size_t)count + 1, (size_t)kinds[of].size);
        *(int64_t *)(at + 8) = count;
        walk_rows(at, of, fill);
    } else *(int64_t *)at = kind == 'z' ? 0 : whole_number();
}

static void ask(void) {
    static AnyCall given, kept; /* an entry may narrow a table within what it is given */
    const Entry *entry = &entries[byte() % (sizeof(entries) / sizeof(*entries))];
    walk(entry->given, (char *)&given, fill);
    kept = given;
    run(entry->run, &given);
    walk(entry->given, (char *)&kept, free_table);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    bytes = data, left = size;
    if (byte() & 1) drive();
    else ask();
    return 0;
}
