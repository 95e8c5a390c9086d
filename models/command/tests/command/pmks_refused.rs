//! Refusals of files of PMKS and PMKS+ that cannot be imported.

use std::fs;

use super::imports::{data, refused};

#[test]
fn refusals_of_pmks_name_the_joint() {
    let says = |content: &str, message: &str| assert_eq!(refused("f.txt", content, ""), message);
    says(
        "ground, input,R,0,0.00\ninput, output,G,4,0.00\noutput ground,R,10,0.00",
        "the joint P1 is a contact of gear teeth (G), which is not imported",
    );
    says("mech=\nground,a,R,0,0\na,b,4,5", "the joint P1 has no kind R, P or RP: `a,b,4,5`");
    says("ground,a,R,0", "the joint P0 has no place x, y: `ground,a,R,0`");
    says("R,0,0", "the joint P0 is on no link: `R,0,0`");
    says("ground,a,R,0,up", "the joint P0 has `up` in the place of a number below 1e9");
    says("ground,a,R,1e12,0", "the joint P0 has `1e12` in the place of a number below 1e9");
    says("ground,gnd,R,0,0", "the joint P0 is on one link twice");
    says("ground,a,b,P,0,0\na,R,1,1", "the joint P0 slides without turning and joins more than two links");
    says(
        "ground,a,RP,0,0,0,ffft\na,R,1,1",
        "the joint P0 is the input and of the kind RP: it has two freedoms",
    );
    says("ground,a,R,0,0\na,R,1,1,0,ffft", "the joint P1 is the input and on one link alone");
    says("ground,a,R,0,0\na,R,1,1\nd=7", "its input is the joint P7, which the file does not have");
    says(
        "d=first\nground,a,R,0,0",
        "it begins like none of the files that are known (pylinkage, linkage2, \
         pyslvs, pmks, pmks-plus, mjcf, urdf, sdf); --format says which one it is",
    );
    says("mech=\nd=first", "its input `d` is `first`, not the number of a joint");
    says("set=sfast\nground,a,R,0,0", "its speed `set=s` has `fast` in the place of a number below 1e9");
    says(
        "ground,a,R,0,0\na,b,P,1,1,0,ffft\nb,ground,R,3,0",
        "the joint P1 drives a slide between two links that both move, which is not imported",
    );
    says("mech=", "nothing in it moves: no link has two joints");
}

#[test]
fn refusals_of_a_json_of_pmks_name_the_joint() {
    let file = fs::read_to_string(data("pmks_four_bar.pmks")).unwrap();
    let says = |from: &str, to: &str, message: &str| {
        assert!(file.contains(from));
        assert_eq!(refused("f.pmks", &file.replacen(from, to, 1), ""), message);
    };
    says("\"R\"", "\"G\"", "the joint P0 is a contact of gear teeth (G), which is not imported");
    says("\"R\"", "\"S\"", "the joint P0 is of the kind `S`, not R, P or RP");
    says("\"X\": 350.0", "\"Z\": 1", "the joint P1 has no number `X`");
    says("[\"coupler\"]", "[]", "the joint P4 is on no link");
    says("Index\": 0", "Index\": -1", "`DrivingIndex` = `-1` is not the number of a joint");
    says("Index\": 0", "Index\": 9", "its input is the joint P9, which the file does not have");
    assert_eq!(refused("f.pmks", "{}", "--format pmks"), "the file has no list `Joints`");
    let cut = refused("f.pmks", &file[..file.len() / 2], "");
    assert!(cut.starts_with("it is no complete JSON: "), "{cut}");
}

/// A text of PMKS+ with the check of its length.
fn checked(text: &str) -> String {
    let digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    let check = digits.chars().nth(text.len() % digits.len()).unwrap();
    format!("{text}{check}")
}

fn plus(joints: &str, links: &str, rest: &str) -> String {
    checked(&format!("0P.Fe.A,0.201.{joints}.{links}.{rest}"))
}

#[test]
fn refusals_of_pmks_plus_name_the_part() {
    let says = |joints: &str, links: &str, rest: &str, message: &str| {
        assert_eq!(refused("f.pmks", &plus(joints, links, rest), "--format pmks-plus"), message);
    };
    let (a, b, bar) = ("6A,A,0,0,0.", "0B,B,Fe,0,0.", "YRAB,AB,Fe,Fe,0,0,0,A,B,,.");
    let both = format!("{a}{b}");
    says(&format!("{a}{a}"), bar, ".N_", "the joint `A` is there twice");
    says("ZA,A,0,0,0.", bar, ".N_", "the joint `A` is a cylinder, which is not imported");
    says("6A,A,0,0.", bar, ".N_", "a joint is not complete: `6A,A,0,0`");
    says("6A,A,?,0,0.", bar, ".N_", "the joint `A` has `?` in the place of a number");
    says("!A,A,0,0,0.", bar, ".N_", "the joint `A` has `!` in the place of flags");
    says("1A,A,0,0,0,AB,B.", bar, ".N_", "the joint `A` slides on a link without two joints of it");
    says(a, bar, ".N_", "the link `AB` refers to the joint `B`, which the file does not have");
    says(&both, "XRAB,AB,Fe,Fe,0,0,0,A,B,,.", ".N_", "the link `AB` is of the kind `X`, which is not known");
    says(&both, "YSAB,AB,Fe,Fe,0,0,0,A,B,,.", ".N_", "the link `AB` is neither a link (R) nor a block (P)");
    says(&both, "YRAB,AB,Fe.", ".N_", "a link is not complete: `YRAB,AB,Fe`");
    let slide = format!("{both}5D,D,Fe,0,0.");
    says(&slide, bar, ".N_", "the joint `D` slides and has no block");
    let block = |joints: &str| format!("{bar}YPBD,BD,0,0,0,0,,{joints},,.");
    says(&slide, &block("D"), ".N_", "the link `BD` is a block with more or less than one pin");
    says(&slide, &block("A,D"), ".N_", "the joint `D` is at another place than its pin");
    says(&slide.replace("5D", "1D"), &block("B,D"), ".N_", "the joint `D` slides on no link");
    let slot = |of: &str| slide.replace("5D,D,Fe,0,0.", &format!("1D,D,Fe,0,0,{of}."));
    says(
        &slot("XY,A,B"),
        &block("B,D"),
        ".N_",
        "the joint `D` refers to the link `XY`, which the file does not have",
    );
    says(&slot("AB,A,A"), &block("B,D"), ".N_", "the joint `D` slides between two joints at one place");
    let between = both.replace("0B", "2B");
    says(
        &between,
        bar,
        ".N_",
        "the joint `B` is an input that is not on the ground; only motors on the ground are imported",
    );
    says(
        &both,
        bar,
        "2F1,XY,F1,0,0,Fe,0,Fe..N_",
        "the force `F1` refers to the link `XY`, which the file does not have",
    );
    says(&both, bar, "2F1,AB,F1,0,0,0,0,Fe..N_", "the force `F1` has no direction");
    says(&both, bar, "2F1,AB,F1,0..N_", "a force is not complete: `2F1,AB,F1,0`");
    says(&both, bar, ".N_.W~1", "it has `W~1`, which only a later PMKS+ knows");
    let ends = |text: &str, message: &str| {
        assert_eq!(refused("f.pmks", &checked(text), "--format pmks-plus"), message);
    };
    ends("0P.Fe", "it ends before its speed");
    ends("0P.Fe.A,0.201.6A,A,0,0,0", "it ends before its links");
    ends("0P.Fe.A,0.201.6A,A,0,0,0.", "it ends before its forces");
    ends("0?.Fe.A,0.201..", "its settings have `0?` in the place of flags");
    let file = plus(&both, bar, ".N_");
    let wrong = "its check at the end does not fit: it is damaged or not complete";
    assert_eq!(refused("f.pmks", &file[1..], "--format pmks-plus"), wrong);
    assert_eq!(
        refused("f.pmks", &file.replace(".201.", ".301."), "--format pmks-plus"),
        "its lengths are in none of the units inch, cm and m"
    );
    let whitworth = fs::read_to_string(data("pmks_plus_whitworth.pmks")).unwrap();
    assert_eq!(refused("f.pmks", &whitworth.replacen("ku", "kv", 1), ""), wrong);
}

/// Addresses of PMKS+ before its version 2 were "like none of the files that are known".
#[test]
fn an_address_of_an_older_pmks_plus_is_named_as_what_it_is() {
    let address = "https://pmks.mech.website/?j=A,AB,0.1,0.2,R,T,0,F,F&l=AB,1,1,A%7CB&f=&pp=&tp=0&unit=cm";
    assert_eq!(
        refused("f.url", address, ""),
        "it is an address of an older PMKS+, which names its parts (`j=`, `l=`); the PMKS+ of today reads it, and what \
         that saves is imported"
    );
}
