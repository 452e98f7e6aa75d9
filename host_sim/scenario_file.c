/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* scandir, S_ISREG */
#include "scenario_file.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define SUFFIX ".ini"
#define FOLDER_VARIABLE "BELT_SIM_SCENARIOS"

static bool ends_in_suffix(const char *name) {
    const size_t length = strlen(name);
    return length >= strlen(SUFFIX) && strcmp(name + length - strlen(SUFFIX), SUFFIX) == 0;
}

static bool is_path(const char *wanted) {
    return strchr(wanted, '/') != NULL || ends_in_suffix(wanted);
}

static const char *shipped_folder(void) {
    const char *const folder = getenv(FOLDER_VARIABLE);
    return folder != NULL && folder[0] != '\0' ? folder : BELT_SIM_SCENARIO_DIR;
}

static char *joined(const char *folder, const char *name, const char *suffix) {
    const size_t size = strlen(folder) + 1 + strlen(name) + strlen(suffix) + 1;
    char *const path = malloc(size);
    if (path != NULL) {
        (void)snprintf(path, size, "%s/%s%s", folder, name, suffix);
    }
    return path;
}

char *scenario_file_path(const char *wanted) {
    if (!is_path(wanted)) {
        return joined(shipped_folder(), wanted, SUFFIX);
    }
    char *const path = malloc(strlen(wanted) + 1);
    return path != NULL ? strcpy(path, wanted) : NULL;
}

static int is_shipped(const struct dirent *entry) {
    return entry->d_name[0] != '.' && ends_in_suffix(entry->d_name);
}

/* Names of the shipped files in their order; -1 when the folder cannot be read. */
static int scan_shipped(struct dirent ***entries) {
    return scandir(shipped_folder(), entries, is_shipped, alphasort);
}

static void free_entries(struct dirent **entries, int count) {
    for (int index = 0; index < count; index++) {
        free(entries[index]);
    }
    free(entries);
}

static void print_known(FILE *messages) {
    struct dirent **entries = NULL;
    const int count = scan_shipped(&entries);
    if (count < 0) {
        fprintf(messages, "; %s: %s", shipped_folder(), strerror(errno));
        return;
    }
    for (int index = 0; index < count; index++) {
        const char *const name = entries[index]->d_name;
        const size_t length = strlen(name) - strlen(SUFFIX);
        fprintf(messages, "%s %.*s", index == 0 ? "; known:" : ",", (int)length, name);
    }
    free_entries(entries, count);
}

/* A pipe would never end, so only regular files are read. */
static FILE *opened(const char *wanted, const char *path, FILE *messages) {
    struct stat status;
    if (stat(path, &status) != 0) {
        if (is_path(wanted)) {
            fprintf(messages, "%s: %s", path, strerror(errno));
        } else {
            fprintf(messages, "%s: no shipped scenario of that name", wanted);
            print_known(messages);
        }
        fputc('\n', messages);
        return NULL;
    }
    if (!S_ISREG(status.st_mode)) {
        fprintf(messages, "%s: is not a regular file\n", path);
        return NULL;
    }
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        fprintf(messages, "%s: %s\n", path, strerror(errno));
    }
    return file;
}

/* One byte more than a scenario may have, so that a longer file shows. */
static bool loaded(const char *wanted, const char *path, char text[SCENARIO_SIZE_MAX + 1],
                   size_t *length, FILE *messages) {
    FILE *const file = opened(wanted, path, messages);
    if (file == NULL) {
        return false;
    }
    *length = fread(text, 1, SCENARIO_SIZE_MAX + 1, file);
    const bool is_whole = ferror(file) == 0;
    if (!is_whole) {
        fprintf(messages, "%s: %s\n", path, strerror(errno));
    }
    (void)fclose(file); /* only read from: nothing to lose */
    return is_whole;
}

bool scenario_file_read(const char *wanted, const scenario_settings_t *settings,
                        scenario_t *scenario, FILE *messages) {
    char *const path = scenario_file_path(wanted);
    char *const text = malloc(SCENARIO_SIZE_MAX + 1);
    size_t length = 0;
    bool is_read = false;
    if (path == NULL || text == NULL) {
        fprintf(messages, "%s: no memory\n", wanted);
    } else if (loaded(wanted, path, text, &length, messages)) {
        is_read = scenario_read_with(text, length, path, settings, scenario, messages);
    }
    free(text);
    free(path);
    return is_read;
}

/* The opening sentence: the comment below the licence line up to the first full stop. */
static void print_opening(FILE *file, FILE *out) {
    char line[256];
    while (fgets(line, sizeof line, file) != NULL && (line[0] == '#' || line[0] == ';')) {
        line[strcspn(line, "\r\n")] = '\0';
        if (strstr(line, "SPDX-License-Identifier") != NULL) {
            continue;
        }
        char *const stop = strstr(line, ". ");
        if (stop != NULL) {
            stop[1] = '\0';
        }
        fprintf(out, "%s", line + 1);
        const size_t length = strlen(line);
        if (line[length - 1] == '.') {
            break;
        }
    }
    fputc('\n', out);
}

bool scenario_file_list(FILE *out, FILE *messages) {
    struct dirent **entries = NULL;
    const int count = scan_shipped(&entries);
    if (count < 0) {
        fprintf(messages, "%s: %s\n", shipped_folder(), strerror(errno));
        return false;
    }
    bool is_listed = true;
    for (int index = 0; index < count && is_listed; index++) {
        const char *const name = entries[index]->d_name;
        char *const path = joined(shipped_folder(), name, "");
        FILE *const file = path != NULL ? fopen(path, "r") : NULL;
        is_listed = file != NULL;
        if (is_listed) {
            fprintf(out, "%-18.*s", (int)(strlen(name) - strlen(SUFFIX)), name);
            print_opening(file, out);
            (void)fclose(file);
        } else {
            fprintf(messages, "%s: %s\n", name, strerror(errno));
        }
        free(path);
    }
    free_entries(entries, count);
    return is_listed;
}
