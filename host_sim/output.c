/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* realpath, mkstemp, fchmod */
#include "output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define TEMPORARY_SUFFIX ".partial-XXXXXX"

static bool complain(const output_t *output, const char *deed, FILE *messages) {
    fprintf(messages, "%s: %s: %s\n", output->path, deed, strerror(errno));
    return false;
}

static char *joined(const char *left, const char *middle, const char *right) {
    const size_t size = strlen(left) + strlen(middle) + strlen(right) + 1;
    char *const text = malloc(size);
    if (text != NULL) {
        (void)snprintf(text, size, "%s%s%s", left, middle, right);
    }
    return text;
}

/* realpath of a file that need not exist yet, in a folder that must. */
static char *resolved(const char *path) {
    char *const whole = realpath(path, NULL);
    if (whole != NULL || errno != ENOENT) {
        return whole;
    }
    const char *const slash = strrchr(path, '/');
    const char *const name = slash != NULL ? slash + 1 : path;
    if (name[0] == '\0') {
        return NULL;
    }
    char *const folder = slash != NULL ? strndup(path, (size_t)(name - path)) : strdup(".");
    char *const real_folder = folder != NULL ? realpath(folder, NULL) : NULL;
    char *const result = real_folder != NULL ? joined(real_folder, "/", name) : NULL;
    free(real_folder);
    free(folder);
    return result;
}

static bool is_disk_trouble(int error) {
    return error == ENOSPC || error == EDQUOT || error == EIO || error == ENOMEM;
}

static mode_t default_mode(void) {
    const mode_t mask = umask(0);
    (void)umask(mask);
    return (mode_t)(0666 & ~mask);
}

static void open_temporary(output_t *output, mode_t mode) {
    output->temporary = joined(output->destination, TEMPORARY_SUFFIX, "");
    const int descriptor = output->temporary != NULL ? mkstemp(output->temporary) : -1;
    if (descriptor < 0) {
        free(output->temporary); /* no file of that name is ours */
        output->temporary = NULL;
        return;
    }
    if (fchmod(descriptor, mode) == 0) {
        output->stream = fdopen(descriptor, "w");
    }
    if (output->stream == NULL) {
        (void)close(descriptor);
    }
}

/* Leaves the stream NULL and errno set when it cannot. */
static void open_stream(output_t *output) {
    struct stat status;
    output->destination = resolved(output->path);
    if (output->destination == NULL) {
        return;
    }
    if (stat(output->path, &status) != 0) {
        open_temporary(output, default_mode());
    } else if (S_ISDIR(status.st_mode)) {
        errno = EISDIR;
    } else if (!S_ISREG(status.st_mode)) {
        output->stream = fopen(output->path, "w");
    } else if (access(output->path, W_OK) == 0) {
        open_temporary(output, status.st_mode & (mode_t)0777);
    }
}

output_status_t output_open(output_t *output, const char *path, FILE *messages) {
    memset(output, 0, sizeof *output);
    output->path = path;
    if (path == NULL) {
        return OUTPUT_READY;
    }
    open_stream(output);
    if (output->stream != NULL) {
        return OUTPUT_READY;
    }
    const int error = errno;
    (void)complain(output, "cannot write", messages);
    output_discard(output);
    return is_disk_trouble(error) ? OUTPUT_FAILED : OUTPUT_REFUSED;
}

bool output_is_same(const output_t *left, const output_t *right) {
    return left->path != NULL && right->path != NULL &&
           strcmp(left->destination, right->destination) == 0;
}

bool output_is_at(const output_t *output, const char *path) {
    char *const place = output->path != NULL ? realpath(path, NULL) : NULL;
    const bool is_at = place != NULL && strcmp(place, output->destination) == 0;
    free(place);
    return is_at;
}

bool output_complete(output_t *output, FILE *messages) {
    if (output->stream == NULL) {
        return true;
    }
    errno = 0;
    const bool is_flushed = fflush(output->stream) == 0 && ferror(output->stream) == 0;
    /* A pipe has nothing to synchronise, and some file systems cannot. */
    const bool is_synchronised =
        is_flushed &&
        (output->temporary == NULL || fsync(fileno(output->stream)) == 0 || errno == EINVAL);
    const int error = errno;
    const bool is_closed = fclose(output->stream) == 0;
    output->stream = NULL;
    if (is_synchronised && is_closed) {
        return true;
    }
    errno = is_synchronised ? errno : error;
    errno = errno != 0 ? errno : EIO;
    return complain(output, "not written", messages);
}

bool output_publish(output_t *output, FILE *messages) {
    if (output->temporary == NULL) {
        return true;
    }
    if (rename(output->temporary, output->destination) != 0) {
        return complain(output, "not renamed", messages);
    }
    free(output->temporary);
    output->temporary = NULL;
    return true;
}

void output_discard(output_t *output) {
    if (output->stream != NULL) {
        (void)fclose(output->stream); /* its bytes are not wanted any more */
    }
    if (output->temporary != NULL) {
        (void)unlink(output->temporary);
    }
    free(output->temporary);
    free(output->destination);
    memset(output, 0, sizeof *output);
}
