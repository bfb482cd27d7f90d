import type { Completion, CompletionContext, CompletionResult, CompletionSource } from "@codemirror/autocomplete";
import { syntaxTree } from "@codemirror/language";
import type { EditorState } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";
import type { SyntaxNode } from "@lezer/common";

interface Schema {
    $ref?: string;
    description?: string;
    type?: string;
    enum?: unknown[];
    const?: unknown;
    properties?: Record<string, Schema>;
    additionalProperties?: Schema | boolean;
    items?: Schema;
    prefixItems?: Schema[];
    anyOf?: Schema[];
    oneOf?: Schema[];
    allOf?: Schema[];
    if?: Schema;
    then?: Schema;
    else?: Schema;
}

/** Completes names and words of a JSON text from a JSON Schema. */
export function completionsOf(root: object): CompletionSource {
    const schema = new SchemaReader(root as Schema);
    return (context) => complete(context, schema);
}

function complete(context: CompletionContext, schema: SchemaReader): CompletionResult | null {
    const { state, pos } = context;
    const inside = syntaxTree(state).resolveInner(pos, -1);
    const word = context.matchBefore(/"?[\w.-]*$/);
    const from = word ? word.from : pos;
    if (!context.explicit && (!word || word.text.length < 2)) return null;
    const isName = inside.name === "PropertyName" || inside.name === "Object" || inside.name === "{" || (inside.parent?.name === "Object" && inside.name === "⚠");
    const holder = isName ? nearest(inside, "Object") : nearest(inside, "Property") ?? nearest(inside, "Array");
    if (!holder) return null;
    const options = isName
        ? schema.names(schema.at(pathOf(holder, state), valueAt(state)))
        : schema.values(schema.at(pathOf(holder.name === "Property" ? holder : inside, state), valueAt(state)));
    return options.length === 0 ? null : { from, options, validFor: /^"?[\w.-]*$/ };
}

function nearest(node: SyntaxNode | null, name: string): SyntaxNode | null {
    while (node && node.name !== name) node = node.parent;
    return node;
}

/** Steps from the root to a node: names of properties, and # for items of lists. */
function pathOf(node: SyntaxNode, state: EditorState): string[] {
    const path: string[] = [];
    for (let at: SyntaxNode | null = node; at; at = at.parent) {
        if (at.name === "Property") path.unshift(nameOf(at, state));
        if (at.parent?.name === "Array") path.unshift("#");
    }
    return path;
}

function nameOf(property: SyntaxNode, state: EditorState): string {
    const name = property.getChild("PropertyName");
    return name ? state.sliceDoc(name.from, name.to).replaceAll('"', "") : "";
}

/** Reads the words that choose between alternatives ("prefab": "rope") from the text before the cursor. */
function valueAt(state: EditorState): (name: string) => Set<string> {
    const text = state.doc.toString();
    return (name) => new Set([...text.matchAll(new RegExp(`"${name}"\\s*:\\s*"(\\w+)"`, "g"))].map((match) => match[1]!));
}

type Chosen = (name: string) => Set<string>;

class SchemaReader {
    constructor(private readonly root: Schema) {}

    /** All schemas that apply at a path: alternatives that the text does not use are left out. */
    at(path: string[], chosen: Chosen): Schema[] {
        let here = this.spread(this.root, chosen);
        for (const step of path) here = here.flatMap((one) => this.child(one, step)).flatMap((one) => this.spread(one, chosen));
        return here;
    }

    private child(schema: Schema, step: string): Schema[] {
        if (step === "#") return [...(schema.items ? [schema.items] : []), ...(schema.prefixItems ?? [])];
        const own = schema.properties?.[step];
        if (own) return [own];
        return typeof schema.additionalProperties === "object" ? [schema.additionalProperties] : [];
    }

    private spread(schema: Schema, chosen: Chosen, depth = 0): Schema[] {
        if (depth > 8) return [];
        if (schema.$ref) {
            const found = schema.$ref.replace(/^#\/?/, "").split("/").filter(Boolean)
                .reduce<unknown>((at, key) => (at as Record<string, unknown> | undefined)?.[key], this.root);
            return found ? this.spread(found as Schema, chosen, depth + 1) : [];
        }
        const more = [...(schema.anyOf ?? []), ...(schema.oneOf ?? []), ...(schema.allOf ?? []), schema.then, schema.else]
            .filter((one): one is Schema => one !== undefined && this.isChosen(one, chosen));
        return [schema, ...more.flatMap((one) => this.spread(one, chosen, depth + 1))];
    }

    private isChosen(schema: Schema, chosen: Chosen): boolean {
        return Object.entries(schema.properties ?? {}).every(([name, one]) => typeof one.const !== "string" || chosen(name).has(one.const));
    }

    names(schemas: Schema[]): CompletionResult["options"] {
        const found = new Map<string, string>();
        for (const { properties } of schemas)
            for (const [name, one] of Object.entries(properties ?? {})) found.set(name, one.description ?? found.get(name) ?? "");
        return [...found].map(([name, about]) => ({ label: `"${name}"`, detail: about.slice(0, 60), type: "property", apply: inserted(`"${name}": `) }));
    }

    values(schemas: Schema[]): CompletionResult["options"] {
        const found = new Set<string>();
        for (const one of schemas) {
            for (const value of one.enum ?? []) found.add(JSON.stringify(value));
            if (one.const !== undefined) found.add(JSON.stringify(one.const));
            if (one.type === "boolean") found.add("true").add("false");
        }
        return [...found].map((label) => ({ label, type: "enum", apply: inserted(label) }));
    }
}

/** Inserts a text in place of what was typed, and of the quote that the editor has closed by itself. */
function inserted(insert: string): (view: EditorView, completion: Completion, from: number, to: number) => void {
    return (view, _, from, to) => {
        const end = view.state.sliceDoc(to, to + 1) === '"' ? to + 1 : to;
        view.dispatch({ changes: { from, to: end, insert }, selection: { anchor: from + insert.length } });
    };
}
