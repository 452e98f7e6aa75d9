/* SPDX-License-Identifier: MIT */
#include "arguments.h"

#include <string.h>

/* Options of one command, and where their values go. */
typedef struct {
    const char *name;
    const char **values;
    size_t *count; /* NULL: stands once at most */
} option_t;

typedef struct {
    int count;
    char *const *text;
    int at;
} words_t;

static bool is_option(const char *word) {
    return word[0] == '-';
}

static bool read_command(const char *word, command_t *command) {
    static const char *const names[] = {"run", "check", "list"};
    static const command_t commands[] = {COMMAND_RUN, COMMAND_CHECK, COMMAND_LIST};
    for (size_t index = 0; index < sizeof names / sizeof names[0]; index++) {
        if (strcmp(word, names[index]) == 0) {
            *command = commands[index];
            return true;
        }
    }
    return false;
}

static bool asks_for_help(const words_t *words) {
    for (int at = 1; at < words->count; at++) {
        if (strcmp(words->text[at], "--help") == 0 || strcmp(words->text[at], "-h") == 0) {
            return true;
        }
    }
    return false;
}

/* The value of the option the words stand at. */
static bool read_option(words_t *words, const option_t *option, FILE *messages) {
    if (words->at + 1 >= words->count || words->text[words->at + 1][0] == '\0' ||
        strncmp(words->text[words->at + 1], "--", 2) == 0) {
        fprintf(messages, "belt_sim: %s has no value\n", option->name);
        return false;
    }
    if (option->count == NULL && *option->values != NULL) {
        fprintf(messages, "belt_sim: %s stands twice\n", option->name);
        return false;
    }
    words->at++;
    option->values[option->count != NULL ? (*option->count)++ : 0] = words->text[words->at];
    return true;
}

static bool find_option(words_t *words, const char **texts, arguments_t *arguments,
                        FILE *messages) {
    scenario_settings_t *const settings = &arguments->settings;
    const option_t options[] = {
        {"--set", texts, &settings->count},
        {"--fault", texts + words->count, &settings->fault_count},
        {"--trace", &arguments->paths.trace, NULL},
        {"--density", &arguments->paths.density, NULL},
        {"--summary", &arguments->paths.summary, NULL},
    };
    const char *const word = words->text[words->at];
    const bool writes_files = arguments->command == COMMAND_RUN;
    const size_t count = writes_files ? sizeof options / sizeof options[0] : 2;
    for (size_t index = 0; index < count && arguments->command != COMMAND_LIST; index++) {
        if (strcmp(word, options[index].name) == 0) {
            return read_option(words, &options[index], messages);
        }
    }
    fprintf(messages, "belt_sim: unknown option %s for %s\n", word, words->text[1]);
    return false;
}

static bool read_scenario(const char *word, arguments_t *arguments, FILE *messages) {
    if (arguments->command == COMMAND_LIST || arguments->scenario != NULL || word[0] == '\0') {
        fprintf(messages, "belt_sim: \"%s\" is one argument too many\n", word);
        return false;
    }
    arguments->scenario = word;
    return true;
}

bool arguments_read(int argument_count, char *const argument[], const char **texts,
                    arguments_t *arguments, FILE *messages) {
    words_t words = {argument_count, argument, 2};
    memset(arguments, 0, sizeof *arguments);
    arguments->settings.text = texts;
    arguments->settings.fault = texts + argument_count;
    if (asks_for_help(&words)) {
        arguments->command = COMMAND_HELP;
        return true;
    }
    if (argument_count < 2 || !read_command(argument[1], &arguments->command)) {
        fprintf(messages,
                "belt_sim: the command must be run, check or list; see belt_sim --help\n");
        return false;
    }
    for (; words.at < words.count; words.at++) {
        const char *const word = words.text[words.at];
        const bool is_read = is_option(word) ? find_option(&words, texts, arguments, messages)
                                             : read_scenario(word, arguments, messages);
        if (!is_read) {
            return false;
        }
    }
    if (arguments->command != COMMAND_LIST && arguments->scenario == NULL) {
        fprintf(messages, "belt_sim: %s wants a scenario; see belt_sim list\n", argument[1]);
        return false;
    }
    return true;
}

void arguments_help(FILE *out) {
    fputs(
        "belt_sim run SCENARIO [--set section.key=value]... [--fault FAULT]... [--trace FILE]\n"
        "             [--density FILE] [--summary FILE]\n"
        "                     simulate; the summary goes to standard output unless a file is "
        "named\n"
        "belt_sim check SCENARIO [--set section.key=value]... [--fault FAULT]...\n"
        "                     say whether every rule holds\n"
        "belt_sim list        name the shipped scenarios\n"
        "\n"
        "SCENARIO with a / or ending in .ini is a file, anything else a shipped scenario.\n"
        "FAULT is signal:word[=value]@start+length, for example buffer_level:stuck@5+2.\n"
        "  signals: buffer_level, outlet_flux, applied_flux, density (as measured), valve, period\n"
        "  words:   off, stuck, garbage, wrong=factor, slow=time constant, delayed=time,\n"
        "           intermittent=share lost; valve without garbage, period without slow, delayed;\n"
        "           period:off is a power cut, period:stuck a task that hangs\n"
        "Exit: 0 done, 1 the run failed, 2 bad input or usage (no output file is touched).\n",
        out);
}
