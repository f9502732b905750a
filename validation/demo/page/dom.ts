// SPDX-License-Identifier: GPL-3.0-or-later
// Small helpers for the page's elements.

type Attributes = Record<string, string | number | boolean>;

/** The element of index.html with this id; that it is missing would be a fault of the page itself. */
export function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  const element = document.getElementById(id);
  if (!element) throw new Error(`index.html has no element #${id}`);
  return element as Kind;
}

export function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

/** Of some buttons those that are chosen. */
export function press(buttons: Iterable<Element>, isChosen: (button: HTMLElement) => boolean): void {
  for (const button of buttons) button.setAttribute("aria-pressed", String(isChosen(button as HTMLElement)));
}

/** Words that are said again would be read aloud again. */
export function say(id: string, words: string): void {
  const line = byId(id);
  if (line.textContent !== words) line.textContent = words;
}

export function svg<Tag extends keyof SVGElementTagNameMap>(tag: Tag, attributes: Record<string, string | number>): SVGElementTagNameMap[Tag] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}
