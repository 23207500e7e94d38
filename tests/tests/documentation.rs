//! Protects the pages of the documentation that are generated.

use shadowstep_tests::catalogue_page::catalogue_pages;
use shadowstep_tests::pages::assert_page;

#[test]
fn the_pages_of_schemes_are_what_their_tables_say() {
    catalogue_pages().iter().for_each(|(name, page)| assert_page(&format!("docs/{name}"), page));
}
